// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/data/occupancy_grid.h"

namespace sigloc
{
using mrpt::maps::COccupancyGridMap2D;

COccupancyGridMap2D::Ptr detail::occupancyGridOf(const OccupancyRaster& raster)
{
  auto grid = COccupancyGridMap2D::Create();
  const RasterFrame& frame = raster.frame;
  const auto at = [](double origin, double cells, double resolution)
  { return static_cast<float>(origin + cells * resolution); };
  grid->setSize(at(frame.origin.x, 0, 1), at(frame.origin.x, frame.width, frame.resolution),
                at(frame.origin.y, 0, 1), at(frame.origin.y, frame.height, frame.resolution),
                static_cast<float>(frame.resolution));
  const auto width = static_cast<int>(frame.width);
  for (int y = 0; y < static_cast<int>(frame.height); ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const CellState state =
          raster.cells[static_cast<std::size_t>(y) * frame.width + static_cast<std::size_t>(x)];
      const float free = state == CellState::free ? 0.95F : state == CellState::wall ? 0.05F : 0.5F;
      grid->setCell(x, y, free);
    }
  }
  auto& options = grid->likelihoodOptions;
  options.likelihoodMethod = COccupancyGridMap2D::lmLikelihoodField_Thrun;
  options.LF_decimation = 20;
  options.LF_stdHit = 0.20F;
  options.LF_maxCorrsDistance = 0.30F;
  options.LF_zHit = 0.95F;
  options.LF_zRandom = 0.05F;
  options.LF_maxRange = 80.0F;
  options.LF_alternateAverageMethod = false;
  return grid;
}
}  // namespace sigloc
