// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/map_scans.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "eval/worlds/Random.h"
#include "sigloc/map/sensor_model.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kClearance = 0.3;  // [m]
constexpr double kFarthest = 30;  // [m] that the laser sees
constexpr double kNothing = 1000;  // [m] through unknown space: no surface in it
constexpr std::uint64_t kStream = 700;  // of the random numbers, see Random

SimulatedLaserOptions laserOf(const MapScanOptions& options)
{
  SimulatedLaserOptions laser;
  laser.beams = static_cast<std::uint32_t>(std::lround(options.view_deg));
  laser.angle_step = M_PI / 180;
  laser.first_angle = -0.5 * (laser.beams - 1) * laser.angle_step;
  laser.max_range = kFarthest;
  laser.range_sigma = options.range_sigma;
  laser.map_sigma = options.map_sigma;
  laser.clutter_share = laser.moved_share = laser.lost_share = 0;
  laser.unknown_range = kNothing;
  laser.thin_share = 1;
  return laser;
}

/// True when a square of the clearance around a cell is free.
bool isClear(const OccupancyRaster& raster, std::size_t column, std::size_t row)
{
  const auto margin = static_cast<std::size_t>(std::ceil(kClearance / raster.frame.resolution));
  if (column < margin || row < margin || column + margin >= raster.frame.width ||
      row + margin >= raster.frame.height)
  {
    return false;
  }
  for (std::size_t y = row - margin; y <= row + margin; ++y)
  {
    for (std::size_t x = column - margin; x <= column + margin; ++x)
    {
      if (raster.cells[y * raster.frame.width + x] != CellState::free) return false;
    }
  }
  return true;
}

std::vector<TPoint2D> clearPlaces(const OccupancyRaster& raster)
{
  std::vector<TPoint2D> places;
  for (std::size_t row = 0; row < raster.frame.height; ++row)
  {
    for (std::size_t column = 0; column < raster.frame.width; ++column)
    {
      if (!isClear(raster, column, row)) continue;
      places.push_back(raster.frame.origin +
                       TPoint2D(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5) *
                           raster.frame.resolution);
    }
  }
  return places;
}
}  // namespace

std::vector<EvaluationQuery> scansInMap(const EvaluationMap& map, const MapScanOptions& options)
{
  if (!map.features->field()) throw std::invalid_argument("scans need a map with a dense field");
  const DenseField& field = *map.features->field();
  const std::vector<TPoint2D> places = clearPlaces(rasterOf(field));
  if (places.empty()) throw std::invalid_argument("the map has no free place for a robot");
  const ScanSimulator simulator(field, laserOf(options));
  Random random(options.seed, kStream);
  std::vector<EvaluationQuery> queries;
  for (std::uint32_t i = 0; i < options.count; ++i)
  {
    const TPoint2D& place = places[random.index(places.size())];
    const TPose2D truth(place.x, place.y, random.uniform(-M_PI, M_PI));
    EvaluationQuery query;
    query.name = std::to_string(i);
    query.scans = {simulator.scan(truth, random.index(1U << 31U))};
    query.truth = truth;
    queries.push_back(std::move(query));
  }
  return queries;
}
}  // namespace sigloc
