// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "command_line.h"
#include "sigloc/io/map_files.h"

namespace sigloc::test
{
/// The occupancy raster of the office.
inline OccupancyRaster officeRaster()
{
  return std::get<OccupancyRaster>(readMapSource(kSources / "maps/office.gridmap.gz"));
}

/// A raster as a PGM image: walls black, free cells 254, unknown ones 205.
inline std::string imageOf(const OccupancyRaster& raster)
{
  std::string image = "P5\n" + std::to_string(raster.frame.width) + " " +
                      std::to_string(raster.frame.height) + "\n255\n";
  for (std::uint32_t row = raster.frame.height; row-- > 0;)
  {
    for (std::uint32_t column = 0; column < raster.frame.width; ++column)
    {
      const CellState state = raster.cells[std::size_t{row} * raster.frame.width + column];
      const int grey = isWall(state) ? 0 : state == CellState::free ? 254 : 205;
      image.push_back(static_cast<char>(grey));
    }
  }
  return image;
}
}  // namespace sigloc::test
