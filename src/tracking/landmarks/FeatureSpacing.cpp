// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/landmarks/FeatureSpacing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
bool isPlace(FeatureType type)
{
  return isPointLike(type) && !hasBearing(type);
}

/// Returns the distance [m] to the nearest other feature of the type within `reach` [m], or a
/// negative number without one.
double nearestWithin(const PreparedMap& map, std::size_t k, FeatureType type, double reach)
{
  double nearest = -1;
  map.grid().visitNear(map.view(k).position(), reach, type,
                       [&](std::uint32_t other)
                       {
                         if (other == k) return;
                         const double distance =
                             (map.view(other).position() - map.view(k).position()).norm();
                         if (nearest < 0 || distance < nearest) nearest = distance;
                       });
  return nearest;
}
}  // namespace

FeatureSpacing::FeatureSpacing(const PreparedMap& map) : map_(map)
{
  std::array<std::vector<double>, kFeatureTypes> distances;
  for (std::size_t k = 0; k < map.size(); ++k)
  {
    const FeatureType type = map.view(k).type();
    if (!isPlace(type)) continue;
    const double farthest = 2.0 * std::sqrt(map.area());
    double nearest = -1;
    for (double reach = 1.0 / std::sqrt(map.clutterDensity(type)); nearest < 0; reach *= 2)
    {
      nearest = nearestWithin(map, k, type, reach);
      if (reach > farthest) break;
    }
    if (nearest >= 0) distances[typeIndex(type)].push_back(nearest);
  }
  for (std::size_t t = 0; t < kFeatureTypes; ++t)
  {
    const std::vector<double>& all = distances[t];
    if (all.empty()) continue;
    spacing_[t] = std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
  }
}

double FeatureSpacing::clutterDensity(FeatureType type) const
{
  const double wide = 2 * spacing_[typeIndex(type)];
  const double whole = map_.clutterDensity(type);
  return wide > 0 ? std::max(whole, 1.0 / (wide * wide)) : whole;
}

bool FeatureSpacing::isMapped(const TPoint2D& place, FeatureType type) const
{
  const double wide = 2 * spacing_[typeIndex(type)];
  if (wide <= 0) return true;
  bool found = false;
  map_.grid().visitNear(place, wide, type,
                        [&](std::uint32_t k)
                        { found |= (map_.view(k).position() - place).norm() <= wide; });
  return found;
}
}  // namespace sigloc
