// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include "io/maps/map_source_readers.h"
#include "sigloc/io/map_files.h"

namespace sigloc
{
std::string detail::warningOfField(const DenseField& field)
{
  constexpr double kCoarsest = 0.5;  // [m] a cell; walls and doors are lost in coarser ones
  constexpr double kSmallest = 4;  // [m^2] of free space
  const double cell = field.frame.resolution;
  const double walls = field.wall_cells * cell * cell;
  if (walls > field.free_area)
  {
    return fmt::format("has {:.0f} m2 of wall and {:.0f} m2 of free space; are they swapped?",
                       walls, field.free_area);
  }
  if (cell > kCoarsest)
  {
    return fmt::format("has cells of {:.2f} m; is its resolution in metres?", cell);
  }
  if (field.free_area >= kSmallest) return {};
  return fmt::format("has {:.1f} m2 of free space; is its resolution in metres?", field.free_area);
}

std::string warningOfMap(const FeatureMap& map)
{
  constexpr std::size_t kFewFeatures = 10;
  std::string warning = map.field() ? detail::warningOfField(*map.field()) : "";
  if (!warning.empty() || map.features().size() >= kFewFeatures) return warning;
  return fmt::format("has only {} features, too few to localize in", map.features().size());
}
}  // namespace sigloc
