// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/map/map_building.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "map/building/FeatureMerger.h"
#include "map/building/wall_end_lengths.h"
#include "map/RayCaster.h"
#include "map/scene_in_map.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr std::size_t kCastBeams = 360;
constexpr double kCastClearance = 0.2;  // [m] least distance of a scanner from a wall
constexpr double kCastSigma = 0.02;  // [m] of a cast range, because of the raster's cells
constexpr double kCellsOffLine = 1.2;  // [cells] from a line, up to which returns count as straight

/// Returns the free place nearest to the middle of a block of the raster, with clearance to walls.
std::optional<TPoint2D> standingPlace(const DenseField& field, std::uint32_t x0, std::uint32_t y0,
                                      std::uint32_t block)
{
  const RasterFrame& frame = field.frame;
  const auto clearance = static_cast<std::uint8_t>(kCastClearance / DenseField::kDistanceUnit);
  const std::uint32_t x1 = std::min(x0 + block, frame.width);
  const std::uint32_t y1 = std::min(y0 + block, frame.height);
  const double middle_x = 0.5 * (x0 + x1);
  const double middle_y = 0.5 * (y0 + y1);
  double best = 1e18;
  std::optional<TPoint2D> place;
  for (std::uint32_t y = y0; y < y1; ++y)
  {
    for (std::uint32_t x = x0; x < x1; ++x)
    {
      const DenseCell& cell = field.at(x, y);
      if (cell.state() != CellState::free || cell.distance() < clearance) continue;
      const double d = std::hypot(x + 0.5 - middle_x, y + 0.5 - middle_y);
      if (d >= best) continue;
      best = d;
      place = TPoint2D(frame.origin.x + (x + 0.5) * frame.resolution,
                       frame.origin.y + (y + 0.5) * frame.resolution);
    }
  }
  return place;
}

LaserScan castScan(const RayCaster& caster, const TPoint2D& place, double range)
{
  LaserScan scan;
  scan.first_angle = -M_PI;
  scan.angle_step = 2 * M_PI / static_cast<double>(kCastBeams);
  scan.max_range = range;
  scan.range_sigma = kCastSigma;
  scan.ranges.resize(kCastBeams);
  scan.valid.resize(kCastBeams);
  for (std::size_t i = 0; i < kCastBeams; ++i)
  {
    const double angle = angleOf(scan, i);
    const std::optional<double> hit = caster.cast(place, angle, range);
    scan.ranges[i] = hit ? static_cast<float>(*hit) : 0.0F;
    scan.valid[i] = hit ? 1 : 0;
  }
  return scan;
}
}  // namespace

FeatureMap buildMapFromRaster(const OccupancyRaster& raster, const MapBuildingOptions& options,
                              const FeatureExtractorOptions& extraction,
                              const MapProvenance& provenance, const MapProgress& progress)
{
  checkOptions(options);
  DenseField field = buildDenseField(raster);
  if (field.wall_cells == 0)
  {
    throw std::invalid_argument("buildMapFromRaster: the raster has no wall");
  }
  // A wall of cells is a staircase, so the limit of what counts as straight grows with the cell.
  FeatureExtractorOptions cast_extraction = extraction;
  cast_extraction.split_distance =
      std::max(extraction.split_distance, kCellsOffLine * raster.frame.resolution);
  MapBuildingOptions cast_merging = options;
  cast_merging.min_sightings = options.min_cast_sightings;
  cast_merging.merge_offset =
      std::max(options.merge_offset, kCellsOffLine * raster.frame.resolution);
  const RayCaster caster(field);
  FeatureMerger merger(cast_merging);
  const auto block = static_cast<std::uint32_t>(
      std::max(1.0, std::round(options.cast_spacing / raster.frame.resolution)));
  for (std::uint32_t y = 0; y < raster.frame.height; y += block)
  {
    for (std::uint32_t x = 0; x < raster.frame.width; x += block)
    {
      const auto place = standingPlace(field, x, y, block);
      if (!place) continue;
      const LaserScan scan = castScan(caster, *place, options.cast_range);
      merger.add(inMap(observeScene({scan}, cast_extraction), {place->x, place->y, 0}));
    }
    if (progress) progress(std::min(1.0, static_cast<double>(y + block) / raster.frame.height));
  }
  std::vector<Feature> features = merger.features();
  setWallEndLengths(features);
  return FeatureMap(std::move(features), inTilesWhereSparse(std::move(field)), {}, provenance);
}
}  // namespace sigloc
