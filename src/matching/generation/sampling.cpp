// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/generation/sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sigloc
{
double rivalShare(std::size_t explained, std::size_t size)
{
  constexpr double kLackingShare = 0.1;
  constexpr double kLackingAlways = 2;
  const auto all = static_cast<double>(explained);
  const double kept = all - std::max(kLackingAlways, kLackingShare * all);
  double share = 1;
  for (std::size_t k = 0; k < size; ++k)
  {
    const auto taken = static_cast<double>(k);
    share *= std::max(0.0, kept - taken) / std::max(1.0, all - taken);
  }
  return share;
}

double combinations(std::size_t n, std::size_t k)
{
  double product = 1;
  for (std::size_t i = 0; i < k; ++i)
  {
    product *= n > i ? static_cast<double>(n - i) / static_cast<double>(i + 1) : 0;
  }
  return product;
}
std::uint32_t drawsNeeded(double failure, double success)
{
  if (success >= 1) return 1;
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (!(success > 0)) return kMost;
  const double draws = std::ceil(std::log(failure) / std::log1p(-success));
  return draws < kMost ? static_cast<std::uint32_t>(draws) : kMost;
}

std::vector<std::uint32_t> observedOf(const FeatureHypothesis& hypothesis)
{
  std::vector<std::uint32_t> observed;
  for (const FeaturePairing& pairing : hypothesis.pairings) observed.push_back(pairing.observed);
  std::sort(observed.begin(), observed.end());
  return observed;
}
}  // namespace sigloc
