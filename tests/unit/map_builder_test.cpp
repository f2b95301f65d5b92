// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/MapBuilder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "bridge/sample_maps.h"
#include "map/building/counted_field.h"
#include "map/field_tiles.h"

using namespace sigloc;
using mrpt::math::TPose2D;

namespace
{
constexpr double kHalf = 3.0;  // [m], of the rooms
constexpr double kDoor = 0.6;  // [m], half its width

/// The scan from inside a square room around `centre` with a door in its right wall.
PosedScans scansAround(const TPose2D& pose, const mrpt::math::TPoint2D& centre)
{
  LaserScan scan;
  scan.first_angle = -M_PI;
  scan.angle_step = 2 * M_PI / 360;
  scan.max_range = 20;
  for (int i = 0; i < 360; ++i)
  {
    const double angle = pose.phi + scan.first_angle + i * scan.angle_step;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double to_x = (std::copysign(kHalf, c) + centre.x - pose.x) / c;
    const double to_y = (std::copysign(kHalf, s) + centre.y - pose.y) / s;
    const bool through_door =
        to_x < to_y && c > 0 && std::abs(pose.y + to_x * s - centre.y) < kDoor;
    scan.ranges.push_back(static_cast<float>(std::min(to_x, to_y)));
    scan.valid.push_back(through_door ? 0 : 1);
  }
  return {pose, {scan}};
}

/// Scans from random positions in rooms that lie in all directions from the first one.
std::vector<PosedScans> tour(std::size_t scans, std::uint32_t seed)
{
  const std::vector<mrpt::math::TPoint2D> rooms = {{0, 0},   {6.2, 0},   {-6.2, 0.1}, {0, -6.2},
                                                   {0.1, 9}, {-20, -14}, {31, 6}};
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-2.2, 2.2);
  std::vector<PosedScans> all;
  for (std::size_t i = 0; i < scans; ++i)
  {
    const auto& room = rooms[(i / 3) % rooms.size()];
    const double x = room.x + shift(random);
    const double y = room.y + shift(random);
    all.push_back(scansAround({x, y, shift(random)}, room));
  }
  return all;
}

/// A raster that scans overwrite wherever they observe a cell.
OccupancyRaster overlaid(const OccupancyRaster& base, const std::vector<PosedScans>& scans)
{
  const MapBuildingOptions options;
  BeamCounts counts(base.frame.resolution, base.frame.origin);
  for (const PosedScans& posed : scans) counts.add(posed, options.raster_range);
  CellBox box = counts.box();
  const auto width = static_cast<std::int32_t>(base.frame.width);
  const auto height = static_cast<std::int32_t>(base.frame.height);
  box = {{std::min(box.low.x, 0), std::min(box.low.y, 0)},
         {std::max(box.high.x, width), std::max(box.high.y, height)}};
  OccupancyRaster all = counts.raster(box, options.min_hits);
  for (std::int32_t y = 0; y < height; ++y)
  {
    for (std::int32_t x = 0; x < width; ++x)
    {
      const auto here = static_cast<std::size_t>((y - box.low.y) * box.width() + x - box.low.x);
      const auto there = static_cast<std::size_t>(y * width + x);
      if (all.cells[here] != CellState::unknown) continue;
      all.cells[here] = base.cells[there];
      all.hits[here] = base.hits[there];
    }
  }
  return all;
}
}  // namespace

TEST(MapBuilder, LearnsLookByLookWhatABatchLearns)
{
  for (const std::uint32_t min_hits : {1U, 3U})
  {
    MapBuildingOptions options;
    options.min_hits = min_hits;
    const std::vector<PosedScans> scans = tour(42, 7);
    MapBuilder asked_often(options);
    MapBuilder asked_once(options);
    for (std::size_t i = 0; i < scans.size(); ++i)
    {
      asked_often.add(scans[i]);
      asked_once.add(scans[i]);
      if (i % 2 == 0) asked_often.field();
      if (i % 7 != 0) continue;
      const std::vector<PosedScans> so_far(scans.begin(),
                                           scans.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      test::expectSameMap(asked_often.map(), buildMapFromScans(so_far, options));
    }
    test::expectSameMap(asked_often.map(), asked_once.map());
    test::expectSameField(*asked_often.map().field(),
                          buildDenseField(rasterFromScans(scans, options)));
  }
}

TEST(DenseFieldOf, IsSolvedInStripsAsInOnePiece)
{
  BeamCounts counts(0.05);
  for (const PosedScans& posed : tour(42, 7)) counts.add(posed, 30);
  ASSERT_GT(counts.box().height(), 256) << "several strips of the least height";
  for (const std::uint32_t min_scans : {1U, 3U})
  {
    test::expectSameField(denseFieldOf(counts, min_scans, 1),
                          buildDenseField(counts.raster(counts.box(), min_scans)));
  }
}

/// Scans of two tours, far apart along both axes.
std::vector<PosedScans> toursApart(double metres)
{
  std::vector<PosedScans> scans = tour(24, 7);
  for (PosedScans posed : tour(24, 9))
  {
    posed.map_from_robot.x += metres;
    posed.map_from_robot.y += metres;
    scans.push_back(std::move(posed));
  }
  return scans;
}

TEST(DenseFieldOf, IsSolvedInTilesAsInOnePiece)
{
  BeamCounts counts(0.05);
  for (const PosedScans& posed : toursApart(83)) counts.add(posed, 30);
  const DenseField tiled = denseFieldOf(counts, 1, 1 << 22, 0);
  ASSERT_TRUE(tiled.isTiled());
  const DenseField whole = buildDenseField(counts.raster(counts.box(), 1));
  test::expectSameField(wholeField(tiled), whole);
  EXPECT_EQ(tiled.cells.size(), inTilesWhereSparse(whole, 0).cells.size());
}

TEST(BuildMapFromScans, CostsWhatIsMappedAndNotTheBoxAroundIt)
{
  const std::vector<PosedScans> scans = toursApart(5000);
  const FeatureMap map = buildMapFromScans(scans);
  const FeatureMap one = buildMapFromScans({scans.begin(), scans.begin() + 24});
  const DenseField& field = *map.field();
  ASSERT_TRUE(field.isTiled());
  EXPECT_GT(1.0 * field.frame.width * field.frame.height, 1e10) << "cells of 25 km2";
  EXPECT_LT(field.cells.size(), 2 * one.field()->cells.size() + 100 * DenseField::kTileCells);
  EXPECT_LT(sizeof(std::uint32_t) * field.tiles.size(), 11e6);
  EXPECT_NEAR(field.free_area, 2 * one.field()->free_area, 0.02 * field.free_area);
}

TEST(BuildMapFromScans, NamesTheScanThatIsFarFromTheOthers)
{
  std::vector<PosedScans> scans = tour(24, 7);
  scans[5].map_from_robot = {52000, -8000, 0};
  try
  {
    buildMapFromScans(scans);
    FAIL();
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_NE(std::string(error.what()).find("scan 6 at (52000.0, -8000.0) m"), std::string::npos)
        << error.what();
  }
}

TEST(MapBuilder, ExtendsAMapLookByLook)
{
  const std::vector<PosedScans> scans = tour(30, 8);
  const std::vector<PosedScans> first(scans.begin(), scans.begin() + 9);
  const auto base = std::make_shared<FeatureMap>(buildMapFromScans(first));
  MapBuilder builder({}, base);
  test::expectSameMap(builder.map(), *base);
  for (std::size_t i = 9; i < scans.size(); ++i)
  {
    builder.add(scans[i]);
    builder.field();
  }
  const FeatureMap extended = builder.map();
  const std::vector<PosedScans> later(scans.begin() + 9, scans.end());
  test::expectSameField(*extended.field(),
                        buildDenseField(overlaid(rasterOf(*base->field()), later)));
  ASSERT_GT(extended.features().size(), base->features().size());
  for (std::size_t k = 0; k < base->features().size(); ++k)
  {
    test::expectSameFeature(extended.features()[k], base->features()[k]);
  }
}

TEST(MapBuilder, ALookCostsWhatItSees)
{
  // The rooms are visited in turn: the map is complete after one round.
  const std::vector<PosedScans> scans = tour(21 * 6, 9);
  MapBuilder builder;
  std::vector<std::uint64_t> work;  // of each round
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < scans.size(); ++i)
  {
    builder.add(scans[i]);
    builder.field();
    if (i % 21 != 20) continue;
    const std::uint64_t now = builder.cellsCounted() + builder.cellsSolved();
    work.push_back(now - before);
    before = now;
  }
  const std::size_t map_cells = builder.map().field()->cells.size();
  for (const std::uint64_t round : work) EXPECT_LT(round, 21 * map_cells / 6);
  // Every scan moves the walls that it sees a little. It never costs much more than when they were
  // new.
  EXPECT_LT(work.back(), 1.25 * static_cast<double>(work.front()));
}

TEST(MapBuilder, TakesNothingInFromALookThatItRefuses)
{
  const std::vector<PosedScans> scans = tour(6, 10);
  MapBuilder builder;
  for (const PosedScans& posed : scans) builder.add(posed);
  const FeatureMap before = builder.map();
  PosedScans astray = scans.front();
  astray.map_from_robot.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(builder.add(astray), std::invalid_argument);
  astray.map_from_robot.x = 1e7;
  EXPECT_THROW(builder.add(astray), std::invalid_argument);
  PosedScans broken = scans.front();
  broken.scans.front().valid.pop_back();
  EXPECT_THROW(builder.add(broken), std::invalid_argument);
  test::expectSameMap(builder.map(), before);
}

TEST(MapBuilder, IsEmptyUntilSomethingIsSeen)
{
  MapBuilder builder;
  PosedScans blind = tour(1, 11).front();
  blind.scans.front().valid.assign(blind.scans.front().valid.size(), 0);
  builder.add(blind);
  EXPECT_TRUE(builder.empty());
  EXPECT_EQ(builder.field(), nullptr);
  EXPECT_TRUE(builder.map().empty());
}

TEST(BeamCounts, RefuseStoredCountsThatNoScansLeadTo)
{
  BeamCounts::Extent extent;
  extent.add({0, 0});
  const auto restore = [&](const BeamCounts::Count& count)
  {
    BeamCounts::Tile tile;
    tile.set(5, count);
    BeamCounts(0.05).restore(extent, {0, 0}, tile);
  };
  restore({0, 2, 1, 2, 64, -64});
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  for (const BeamCounts::Count& impossible :
       {BeamCounts::Count{0, 1, 0, 2, 0, 0}, BeamCounts::Count{0, 0, 0, 0, 1, 0},
        BeamCounts::Count{0, 2, 1, 2, 65, 0}, BeamCounts::Count{0, 2, 1, 2, 0, kLeast}})
  {
    EXPECT_THROW(restore(impossible), std::invalid_argument);
  }
}
