// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/map/DenseField.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "map/RayCaster.h"
#include "sigloc/map/map_building.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;

OccupancyRaster randomRaster(std::uint32_t width, std::uint32_t height, double resolution,
                             double wall_share, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  OccupancyRaster raster;
  raster.frame = {{-3.0, 2.0}, resolution, width, height};
  for (std::uint32_t k = 0; k < width * height; ++k)
  {
    const double u = uniform(random);
    raster.cells.push_back(u < 0.5 * wall_share    ? CellState::wall
                           : u < wall_share        ? CellState::solid_wall
                           : uniform(random) < 0.5 ? CellState::free
                                                   : CellState::unknown);
  }
  return raster;
}

/// The same raster, its walls hit anywhere and any number of times.
OccupancyRaster withRandomHits(OccupancyRaster raster, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> place(-4, 4);
  std::uniform_int_distribution<int> weight(1, WallHits::kMostWeight);
  for (const CellState state : raster.cells)
  {
    raster.hits.emplace_back();
    if (!isWall(state)) continue;
    raster.hits.back() = {static_cast<std::int8_t>(place(random)),
                          static_cast<std::int8_t>(place(random)),
                          static_cast<std::uint8_t>(weight(random))};
  }
  return raster;
}

/// Distance in cells to the nearest wall cell, by trying them all; infinite without walls.
double nearestByBruteForce(const OccupancyRaster& raster, int x, int y)
{
  double best = std::numeric_limits<double>::infinity();
  const int width = static_cast<int>(raster.frame.width);
  for (int k = 0; k < static_cast<int>(raster.cells.size()); ++k)
  {
    if (!isWall(raster.cells[static_cast<std::size_t>(k)])) continue;
    best = std::min(best, std::hypot(k % width - x, k / width - y));
  }
  return best;
}

/// The mean position of the hits near wall cell (x, y), relative to its middle [m]. The hits are
/// those of the wall cells up to 0.05 m away in x and y, or one cell where cells are larger.
TPoint2D ridgeByBruteForce(const OccupancyRaster& raster, int x, int y)
{
  const double resolution = raster.frame.resolution;
  const int radius = std::max(1, static_cast<int>(std::lround(0.05 / resolution)));
  const int width = static_cast<int>(raster.frame.width);
  double sum = 0;
  TPoint2D moment(0, 0);
  for (int k = 0; k < static_cast<int>(raster.cells.size()); ++k)
  {
    const auto cell = static_cast<std::size_t>(k);
    const TPoint2D d(k % width - x, k / width - y);
    if (!isWall(raster.cells[cell]) || std::abs(d.x) > radius || std::abs(d.y) > radius) continue;
    const WallHits hits = raster.hits.empty() ? WallHits{0, 0, 1} : raster.hits[cell];
    sum += hits.weight;
    moment += (d + TPoint2D(hits.x, hits.y) * 0.125) * (hits.weight * resolution);
  }
  return moment * (1.0 / sum);
}

/// Whether the offset of cell (x, y) leads to the ridge at one of the wall cells nearest to it.
bool leadsToNearestRidge(const OccupancyRaster& raster, const DenseCell& cell, int x, int y,
                         double nearest)
{
  const double resolution = raster.frame.resolution;
  const int width = static_cast<int>(raster.frame.width);
  for (int k = 0; k < static_cast<int>(raster.cells.size()); ++k)
  {
    if (!isWall(raster.cells[static_cast<std::size_t>(k)])) continue;
    const TPoint2D d(k % width - x, k / width - y);
    if (d.norm() > nearest + 1e-9) continue;
    const TPoint2D expected = d * resolution + ridgeByBruteForce(raster, k % width, k / width);
    const double half = 0.5 * DenseField::kOffsetUnit + 1e-6;
    const auto agrees = [&](double wanted, std::int8_t stored)
    {
      const double reached = std::clamp(wanted, -1.27, 1.27);
      return std::abs(reached - stored * DenseField::kOffsetUnit) <= half;
    };
    if (agrees(expected.x, cell.dx) && agrees(expected.y, cell.dy)) return true;
  }
  return false;
}

struct RasterCase
{
  std::uint32_t width, height;
  double resolution, wall_share;
};

TEST(DenseField, EqualsBruteForceOnRandomRasters)
{
  const RasterCase cases[] = {{40, 30, 0.05, 0.02},   {70, 20, 0.05, 0.002}, {1, 50, 0.05, 0.1},
                              {50, 1, 0.05, 0.1},     {30, 30, 0.2, 0.01},   {25, 25, 1.0, 0.05},
                              {60, 60, 0.01, 0.0006}, {33, 17, 0.1, 0.5},    {20, 20, 0.05, 0.0},
                              {200, 5, 0.005, 0.002}};
  std::uint64_t seed = 100;
  for (const RasterCase& c : cases)
  {
    OccupancyRaster raster = randomRaster(c.width, c.height, c.resolution, c.wall_share, ++seed);
    if (seed % 2 == 0) raster = withRandomHits(std::move(raster), seed);
    const DenseField field = buildDenseField(raster);
    ASSERT_EQ(field.cells.size(), raster.cells.size());
    const double radius =
        std::min(127.0, std::floor(126 * DenseField::kDistanceUnit / c.resolution));
    std::uint32_t walls = 0;
    double free_area = 0;
    for (int y = 0; y < static_cast<int>(c.height); ++y)
    {
      for (int x = 0; x < static_cast<int>(c.width); ++x)
      {
        const std::size_t k = static_cast<std::size_t>(y) * c.width + static_cast<std::size_t>(x);
        const DenseCell& cell = field.cells[k];
        EXPECT_EQ(cell.state(), raster.cells[k]);
        walls += isWall(cell.state());
        free_area += cell.state() == CellState::free ? c.resolution * c.resolution : 0;
        const double expected = nearestByBruteForce(raster, x, y);
        if (expected > radius)
        {
          ASSERT_EQ(cell.distance(), DenseCell::kFar) << "truncated at " << x << ", " << y;
          continue;
        }
        ASSERT_NEAR(cell.distance() * DenseField::kDistanceUnit, expected * c.resolution,
                    0.5 * DenseField::kDistanceUnit + 1e-9);
        ASSERT_TRUE(leadsToNearestRidge(raster, cell, x, y, expected)) << x << ", " << y;
      }
    }
    EXPECT_EQ(field.wall_cells, walls);
    EXPECT_NEAR(field.free_area, free_area, 1e-9);
  }
}

TEST(DenseField, LeadsToTheMiddleOfAThickWall)
{
  OccupancyRaster raster;
  raster.frame = {{0, 0}, 0.05, 40, 41};
  raster.cells.assign(40 * 41, CellState::free);
  for (const std::size_t row : {19U, 20U, 21U})
  {
    for (std::size_t x = 0; x < 40; ++x) raster.cells[row * 40 + x] = CellState::wall;
  }
  const DenseField field = buildDenseField(raster);
  // From below and above, far from the wall's ends: nearly to the middle row, not to the outer one.
  EXPECT_NEAR(field.cells[10 * 40 + 20].dy * DenseField::kOffsetUnit, 0.5, 0.035);
  EXPECT_NEAR(field.cells[30 * 40 + 20].dy * DenseField::kOffsetUnit, -0.5, 0.035);
  EXPECT_EQ(field.cells[10 * 40 + 20].dx, 0);
}

TEST(DenseField, RefusesInconsistentRasters)
{
  OccupancyRaster raster = randomRaster(5, 5, 0.05, 0.1, 1);
  raster.cells.pop_back();
  EXPECT_THROW(buildDenseField(raster), std::invalid_argument);
  EXPECT_THROW(buildDenseField({}), std::invalid_argument);
  raster = withRandomHits(randomRaster(5, 5, 0.05, 0.1, 1), 1);
  raster.hits.back().weight = 0;
  EXPECT_THROW(buildDenseField(raster), std::invalid_argument);
  raster.hits.pop_back();
  EXPECT_THROW(buildDenseField(raster), std::invalid_argument);
  for (const double resolution : {0.0, -1.0, 0.001, 2.0, std::nan("")})
  {
    raster = randomRaster(5, 5, 0.05, 0.1, 1);
    raster.frame.resolution = resolution;
    EXPECT_THROW(buildDenseField(raster), std::invalid_argument) << resolution;
  }
}

/// The range at which a ray first enters a wall cell, by small steps along it.
double creep(const OccupancyRaster& raster, const TPoint2D& origin, double angle, double limit)
{
  const RasterFrame& frame = raster.frame;
  for (double along = 0; along < limit; along += 0.002 * frame.resolution / 0.05)
  {
    const double x = (origin.x + along * std::cos(angle) - frame.origin.x) / frame.resolution;
    const double y = (origin.y + along * std::sin(angle) - frame.origin.y) / frame.resolution;
    if (x < 0 || y < 0 || x >= frame.width || y >= frame.height) return -1;
    const std::size_t k = static_cast<std::size_t>(y) * frame.width + static_cast<std::size_t>(x);
    if (isWall(raster.cells[k])) return along;
  }
  return -1;
}

TEST(RayCaster, AgreesWithCreepingAlongTheRay)
{
  std::uint64_t seed = 7;
  for (const double resolution : {0.005, 0.01, 0.05, 0.2})
  {
    // Walls several cells thick, so that no ray slips through a cell's tip.
    OccupancyRaster raster = randomRaster(400, 300, resolution, 0.0, ++seed);
    std::mt19937_64 random(seed);
    std::uniform_int_distribution<std::size_t> column(0, 390);
    std::uniform_int_distribution<std::size_t> row(0, 290);
    for (int block = 0; block < 12; ++block)
    {
      const std::size_t x0 = column(random);
      const std::size_t y0 = row(random);
      for (std::size_t y = y0; y < y0 + 6; ++y)
      {
        for (std::size_t x = x0; x < x0 + 6; ++x) raster.cells[y * 400 + x] = CellState::wall;
      }
    }
    const DenseField field = buildDenseField(raster);
    const RayCaster caster(field);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    int hits = 0;
    int agreed = 0;
    for (int k = 0; k < 400; ++k)
    {
      const TPoint2D origin(-3.0 + 400 * resolution * uniform(random),
                            2.0 + 300 * resolution * uniform(random));
      const double angle = 2 * M_PI * uniform(random);
      const double expected = creep(raster, origin, angle, 1000 * resolution);
      const auto actual = caster.cast(origin, angle, 1000 * resolution);
      hits += expected >= 0;
      agreed += actual.has_value() == (expected >= 0);
      if (actual && expected >= 0)
      {
        EXPECT_NEAR(*actual, expected, 1.5 * resolution);
      }
    }
    // A ray that grazes the tip of a block may miss it: 1 % at most.
    EXPECT_GT(hits, 20) << resolution;
    EXPECT_GE(agreed, 396) << resolution;
  }
}

TEST(RayCaster, StopsAtItsRangeAndOutside)
{
  OccupancyRaster raster = randomRaster(100, 10, 0.05, 0.0, 1);
  for (std::size_t y = 0; y < 10; ++y) raster.cells[y * 100 + 80] = CellState::solid_wall;
  const DenseField field = buildDenseField(raster);
  const RayCaster caster(field);
  const TPoint2D origin(-3.0 + 0.5, 2.0 + 0.25);
  ASSERT_TRUE(caster.cast(origin, 0, 10));
  EXPECT_NEAR(*caster.cast(origin, 0, 10), 3.5, 0.05);
  EXPECT_FALSE(caster.cast(origin, 0, 3.0));
  EXPECT_FALSE(caster.cast(origin, M_PI, 10));
  EXPECT_FALSE(caster.cast({-9, 9}, 0, 10));
}

/// One beam along +x from the origin, `range` long.
PosedScans singleBeam(double range)
{
  LaserScan scan;
  scan.ranges = {static_cast<float>(range)};
  scan.valid = {1};
  scan.angle_step = 0.01;
  PosedScans posed;
  posed.scans = {scan};
  return posed;
}

CellState stateAt(const OccupancyRaster& raster, double x, double y)
{
  const RasterFrame& frame = raster.frame;
  const auto ix = static_cast<std::size_t>((x - frame.origin.x) / frame.resolution);
  const auto iy = static_cast<std::size_t>((y - frame.origin.y) / frame.resolution);
  return raster.cells.at(iy * frame.width + ix);
}

TEST(RasterFromScans, HitCountsMakeWallSolidAndFree)
{
  MapBuildingOptions options;
  options.min_hits = 2;
  // Two scans hit at 2 m, and two others pass there on their way to 3 m; one lone hit at 5 m.
  const std::vector<PosedScans> scans = {singleBeam(2.02), singleBeam(2.02), singleBeam(2.02),
                                         singleBeam(3.02), singleBeam(3.02), singleBeam(5.02)};
  const OccupancyRaster raster = rasterFromScans(scans, options);
  EXPECT_EQ(stateAt(raster, 1.0, 0.01), CellState::free);
  EXPECT_EQ(stateAt(raster, 2.02, 0.01), CellState::solid_wall);  // hit thrice, passed thrice
  EXPECT_EQ(stateAt(raster, 3.02, 0.01), CellState::solid_wall);  // hit twice, passed once
  EXPECT_NE(stateAt(raster, 5.02, 0.01), CellState::solid_wall);
  EXPECT_FALSE(isWall(stateAt(raster, 5.02, 0.01)));  // one hit is too few
  EXPECT_EQ(stateAt(raster, 1.0, 0.5), CellState::unknown);

  // Passed more often than hit: still a wall, but beams go through.
  const OccupancyRaster thin = rasterFromScans(
      {singleBeam(2.02), singleBeam(2.02), singleBeam(4.02), singleBeam(4.02), singleBeam(4.02)},
      options);
  EXPECT_EQ(stateAt(thin, 2.02, 0.01), CellState::wall);
  EXPECT_EQ(stateAt(thin, 4.02, 0.01), CellState::solid_wall);
}

TEST(RasterFromScans, TellsWhereInItsCellAWallWasHit)
{
  // In [2.00, 2.05) m: 5 mm before its middle on average, by two of three scans in the same place.
  const OccupancyRaster raster =
      rasterFromScans({singleBeam(2.010), singleBeam(2.010), singleBeam(2.040)});
  const auto wall = std::find_if(raster.cells.begin(), raster.cells.end(), isWall);
  ASSERT_NE(wall, raster.cells.end());
  const WallHits hits = raster.hits[static_cast<std::size_t>(wall - raster.cells.begin())];
  EXPECT_EQ(hits.x, -1);  // of 6.25 mm
  EXPECT_EQ(hits.y, -4);  // the beam runs along the lower edge of a row
  EXPECT_EQ(hits.weight, 3);
}

TEST(DenseField, LeadsToWhereAWallWasHit)
{
  // Walls along the raster, anywhere in their cells: the middle of a cell is up to 25 mm off.
  for (const double at : {2.003, 2.015, 2.024, 2.036, 2.047})
  {
    LaserScan scan;
    scan.first_angle = -0.6;
    scan.angle_step = 0.002;
    for (int i = 0; i <= 600; ++i)
    {
      scan.ranges.push_back(static_cast<float>(at / std::cos(scan.first_angle + 0.002 * i)));
    }
    scan.valid.assign(scan.ranges.size(), 1);
    PosedScans posed;
    posed.scans = {scan};
    const DenseField field = buildDenseField(rasterFromScans({posed, posed}));
    const DenseCell* cell = cellAt(field, {1.725, 0.025});  // the middle of one
    ASSERT_NE(cell, nullptr);
    EXPECT_NEAR(1.725 + cell->dx * DenseField::kOffsetUnit, at, 0.009) << at;
  }
}

TEST(RasterFromScans, OneScanCountsOnceACell)
{
  PosedScans many = singleBeam(2.02);
  many.scans[0].ranges.assign(5, 2.02F);
  many.scans[0].valid.assign(5, 1);
  many.scans[0].angle_step = 1e-6;
  MapBuildingOptions options;
  options.min_hits = 2;
  EXPECT_FALSE(isWall(stateAt(rasterFromScans({many}, options), 2.02, 0.01)));
  options.min_hits = 1;
  EXPECT_TRUE(isWall(stateAt(rasterFromScans({many}, options), 2.02, 0.01)));
}

TEST(RasterFromScans, RefusesScansWithoutReturnsAndAbsurdPoses)
{
  EXPECT_THROW(rasterFromScans({}), std::invalid_argument);
  PosedScans nothing = singleBeam(2);
  nothing.scans[0].valid[0] = 0;
  EXPECT_THROW(rasterFromScans({nothing}), std::invalid_argument);
  PosedScans far = singleBeam(2);
  far.map_from_robot = {1e7, 1e7, 0};
  EXPECT_THROW(rasterFromScans({far, singleBeam(2)}), std::invalid_argument);
  far.map_from_robot = {std::nan(""), 0, 0};
  EXPECT_THROW(rasterFromScans({far}), std::invalid_argument);
  EXPECT_THROW(rasterFromScans({singleBeam(2), far}), std::invalid_argument);
}
}  // namespace
}  // namespace sigloc
