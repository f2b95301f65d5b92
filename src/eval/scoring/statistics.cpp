// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/scoring/statistics.h"

#include <fmt/core.h>

#include <numeric>

namespace sigloc
{
namespace
{
constexpr double kZ95 = 1.959963984540054;  // two-sided 95 % of the normal distribution

// Centre and half width of Wilson's score interval.
std::pair<double, double> wilson(std::size_t count, std::size_t cases)
{
  const auto n = static_cast<double>(cases);
  const double p = static_cast<double>(count) / n;
  const double z2 = kZ95 * kZ95;
  const double centre = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kZ95 / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  return {centre, half};
}

}  // namespace

void Proportion::add(bool counts)
{
  ++cases;
  count += counts;
}

double Proportion::value() const
{
  return static_cast<double>(count) / static_cast<double>(cases);  // NaN without cases
}

double Proportion::low() const
{
  const auto [centre, half] = wilson(count, cases);
  return cases > 0 && count == 0 ? 0 : centre - half;
}

double Proportion::high() const
{
  const auto [centre, half] = wilson(count, cases);
  return cases > 0 && count == cases ? 1 : centre + half;
}

Quantiles quantilesOf(std::vector<double> values)
{
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  const auto nearest_rank = [&](double share)
  { return values[static_cast<std::size_t>(std::max(1.0, std::ceil(share * n))) - 1]; };
  return {nearest_rank(0.5), nearest_rank(0.95),
          std::accumulate(values.begin(), values.end(), 0.0) / n};
}

std::string withInterval(const Proportion& proportion)
{
  if (proportion.cases == 0) return "-";
  return fmt::format("{:.3f} ({:.2f}-{:.2f})", proportion.value(), proportion.low(),
                     proportion.high());
}

Written written(const Proportion& proportion, int /*decimals*/)
{
  nlohmann::ordered_json interval;
  if (proportion.cases > 0) interval = {proportion.low(), proportion.high()};
  return {{{"", proportion.value()},
           {"_counts", {proportion.count, proportion.cases}},
           {"_interval", interval}},
          {withInterval(proportion)}};
}

Written written(const Quantiles& quantiles, int decimals)
{
  const auto& [median, p95, mean] = quantiles;
  return {{{"", {{"median", median}, {"p95", p95}, {"mean", mean}}}},
          {fixedNumber(median, decimals), fixedNumber(p95, decimals), fixedNumber(mean, decimals)}};
}
}  // namespace sigloc
