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

  /// True where a feature of the map would likely have another mapped one near it: as near as 95 %
  /// of the mapped ones have. Elsewhere nothing is mapped. Always true for other types.
  bool isMapped(const mrpt::math::TPoint2D& place, FeatureType type) const;

 private:
  struct Spacing
  {
    double mean = 0;  // [m] to the nearest neighbour; 0: no neighbours
    double wide = 0;  // [m] that 95 % do not exceed
  };
  const PreparedMap& map_;
  std::array<Spacing, kFeatureTypes> spacing_{};
};
}  // namespace sigloc
