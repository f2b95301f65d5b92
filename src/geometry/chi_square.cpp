// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/chi_square.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <stdexcept>

namespace sigloc
{
double chiSquareGate(double probability, int degrees)
{
  if (!(probability > 0) || !(probability < 1) || degrees < 1)
  {
    throw std::invalid_argument("chiSquareGate: needs 0 < probability < 1 and degrees >= 1");
  }
  return boost::math::quantile(boost::math::chi_squared(degrees), probability);
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
