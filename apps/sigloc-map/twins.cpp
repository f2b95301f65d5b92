// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "twins.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
constexpr double kSameNeighbourhood = 1.5;  // [m]
constexpr double kSameTurn = 0.35;  // [rad] from one place to the other

bool near(const TPose2D& a, const TPose2D& b)
{
  return std::hypot(a.x - b.x, a.y - b.y) < kSameNeighbourhood;
}

bool sameTwins(const Twins& twins, const TPose2D& a, const TPose2D& b)
{
  const double turn = (b.phi - a.phi) - (twins.b.phi - twins.a.phi);
  return near(twins.a, a) && near(twins.b, b) && std::abs(mrpt::math::wrapToPi(turn)) < kSameTurn;
}
}  // namespace

std::vector<Twins> gatherTwins(const std::vector<Confusion>& confusions)
{
  std::vector<Twins> all;
  std::vector<TPose2D>
      latest;  // truth of each: a scan may have several candidates at the other place
  for (const Confusion& confusion : confusions)
  {
    const TPose2D& a = confusion.truth;
    const TPose2D& b = confusion.other;
    const auto known = std::find_if(all.begin(), all.end(),
                                    [&](const Twins& twins)
                                    { return sameTwins(twins, a, b) || sameTwins(twins, b, a); });
    if (known == all.end())
    {
      all.push_back({a, b, 1, confusion.probability});
      latest.push_back(a);
      continue;
    }
    TPose2D& before = latest[static_cast<std::size_t>(known - all.begin())];
    if (before != a) ++known->scans;
    before = a;
    known->weight += confusion.probability;
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Twins& x, const Twins& y) { return x.weight > y.weight; });
  return all;
}
}  // namespace sigloc
