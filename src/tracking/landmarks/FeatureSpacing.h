// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <array>

#include "matching/features/PreparedMap.h"

namespace sigloc
{
/// How far mapped points and circles are apart. They are rarely spread evenly over the area of a
/// map: marks stand along corridors, trees along paths. Other types have no spacing.
/// \cite algorithm section 10
class FeatureSpacing
{
 public:
  /// Keeps a reference to the map, which must outlive it.
  explicit FeatureSpacing(const PreparedMap& map);

  /// Density of the background [in the unit of PreparedMap::clutterDensity] where there are
  /// features at all, by the mean distance of the nearest neighbours (Clark, Evans 1954). At least
  /// that of the whole map. Eq. (8.14)
  double clutterDensity(FeatureType type) const;

  /// True where a mapped feature is within twice the mean distance of the nearest neighbours.
  /// Features spread at random have one there with a probability of 1 - exp(-pi), 96 %. Elsewhere
  /// nothing is mapped. Always true for other types.
  bool isMapped(const mrpt::math::TPoint2D& place, FeatureType type) const;

 private:
  const PreparedMap& map_;
  // [m], mean distance of the nearest neighbours; 0: no neighbours
  std::array<double, kFeatureTypes> spacing_{};
};
}  // namespace sigloc
