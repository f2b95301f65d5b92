// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/chi_square.h"

#include <cmath>
#include <stdexcept>

namespace sigloc
{
namespace
{
// Regularised lower incomplete gamma function P(a, x) by its power series: accurate for the x of
// interest here (a few times a), where it converges within some hundred terms.
double lowerGamma(double a, double x)
{
  double term = std::exp(a * std::log(x) - x - logGamma(a + 1));
  double sum = term;
  for (int k = 1; k < 10000 && term > 1e-17 * sum; ++k)
  {
    term *= x / (a + k);
    sum += term;
  }
  return sum;
}
}  // namespace

double logGamma(double x)
{
  int sign = 0;
  return lgamma_r(x, &sign);
}

double chiSquareGate(double probability, int degrees)
{
  if (!(probability > 0) || !(probability < 1) || degrees < 1)
  {
    throw std::invalid_argument("chiSquareGate: needs 0 < probability < 1 and degrees >= 1");
  }
  // Bisection: the distribution function is monotone and the gates are computed once.
  double low = 0;
  double high = degrees + 10.0;
  while (lowerGamma(0.5 * degrees, 0.5 * high) < probability) high *= 2;
  for (int k = 0; k < 100; ++k)
  {
    const double middle = 0.5 * (low + high);
    (lowerGamma(0.5 * degrees, 0.5 * middle) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

ChiSquareGates::ChiSquareGates(double probability, int max_degrees) : probability_(probability)
{
  for (int degrees = 1; degrees <= max_degrees; ++degrees)
  {
    gates_.push_back(chiSquareGate(probability, degrees));
  }
}

double ChiSquareGates::operator()(int degrees) const
{
  const auto index = static_cast<std::size_t>(degrees - 1);
  return index < gates_.size() ? gates_[index] : chiSquareGate(probability_, degrees);
}
}  // namespace sigloc
