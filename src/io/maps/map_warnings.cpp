// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include "sigloc/io/map_files.h"

namespace sigloc
{
std::string warningOfMap(const FeatureMap& map)
{
  constexpr std::size_t kFewFeatures = 10;
  constexpr double kCoarsest = 0.5;  // [m] a cell; walls and doors are lost in coarser ones
  constexpr double kSmallest = 4;  // [m^2] of free space
  if (map.field())
  {
    const DenseField& field = *map.field();
    const double cell = field.frame.resolution;
    const double walls = field.wall_cells * cell * cell;
    if (walls > field.free_area)
    {
      return fmt::format(
          "has {:.0f} m2 of wall and {:.0f} m2 of free space; are its colours inverted?", walls,
          field.free_area);
    }
    if (cell > kCoarsest)
    {
      return fmt::format("has cells of {:.2f} m; is its resolution in metres?", cell);
    }
    if (field.free_area < kSmallest)
    {
      return fmt::format("has {:.1f} m2 of free space; is its resolution in metres?",
                         field.free_area);
    }
  }
  if (map.features().size() >= kFewFeatures) return {};
  return fmt::format("has only {} features, too few to localize in{}", map.features().size(),
                     map.field() ? "; is its resolution in metres?" : "");
}
}  // namespace sigloc
