// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/field_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "bridge/sample_maps.h"
#include "map/ClearBlocks.h"
#include "map/RayCaster.h"
#include "matching/dense/CoarseField.h"
#include "matching/dense/DenseVerifier.h"
#include "matching/dense/WallCrossings.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

/// Random blocks of wall and free space in two corners of a frame that is empty otherwise. Its
/// sides are no multiples of a tile.
const DenseField& corners()
{
  static const DenseField field = []
  {
    std::mt19937 random(3);
    OccupancyRaster raster;
    raster.frame = {{-7.3, 4.1}, 0.05, 1501, 1333};
    raster.cells.assign(std::size_t{1501} * 1333, CellState::unknown);
    const auto fill = [&](std::uint32_t x0, std::uint32_t y0)
    {
      for (std::uint32_t y = y0; y < y0 + 150; ++y)
      {
        for (std::uint32_t x = x0; x < x0 + 170; ++x)
        {
          const bool edge = x < x0 + 2 || y < y0 + 2 || x >= x0 + 168 || y >= y0 + 148;
          const bool block = (x / 20 * 7 + y / 20 * 3) % 11 == 0;
          raster.cells[std::size_t{y} * 1501 + x] =
              edge || block ? (random() % 4 == 0 ? CellState::wall : CellState::solid_wall)
                            : CellState::free;
        }
      }
    };
    fill(30, 0);
    fill(1331, 1180);
    return buildDenseField(raster);
  }();
  return field;
}

const DenseField& cornersInTiles()
{
  static const DenseField field = inTilesWhereSparse(corners(), 0);
  return field;
}

TPose2D anyPose(std::mt19937& random)
{
  std::uniform_real_distribution<double> share(-0.05, 1.05);
  return {-7.3 + 1501 * 0.05 * share(random), 4.1 + 1333 * 0.05 * share(random),
          2 * M_PI * share(random)};
}

/// What a laser sees from inside the lower left corner.
DenseScan scanOfCorner()
{
  const RayCaster rays(corners());
  ObservedScene scene;
  scene.sensor_origins = {{0, 0}};
  for (int i = 0; i < 180; ++i)
  {
    const double angle = -M_PI + 2 * M_PI * i / 180;
    const auto range = rays.cast({-0.5, 7.0}, angle, 30);
    if (range) scene.beams.push_back({{*range * std::cos(angle), *range * std::sin(angle)}, 0});
  }
  return makeDenseScan(scene, 400);
}

TEST(FieldTiles, HoldEveryCellOfASparseField)
{
  ASSERT_TRUE(cornersInTiles().isTiled());
  EXPECT_LT(2 * cornersInTiles().cells.size(), corners().cells.size());
  test::expectSameField(wholeField(cornersInTiles()), corners());
  for (std::uint32_t y = 0; y < 1333; y += 3)
  {
    for (std::uint32_t x = y % 2; x < 1501; x += 2)
    {
      ASSERT_EQ(cornersInTiles().at(x, y).distance(), corners().at(x, y).distance())
          << x << " " << y;
      ASSERT_EQ(cornersInTiles().at(x, y).state(), corners().at(x, y).state());
    }
  }
  const ShrunkField whole = shrunkField(corners(), 7);
  EXPECT_EQ(shrunkField(cornersInTiles(), 7).states, whole.states);
  EXPECT_EQ(whole.width, 215U);
}

TEST(FieldTiles, AreMadeOnlyOfLargeSparseFields)
{
  EXPECT_FALSE(inTilesWhereSparse(corners()).isTiled()) << "small";
  OccupancyRaster raster;
  raster.frame = {{0, 0}, 0.05, 300, 200};
  raster.cells.assign(std::size_t{300} * 200, CellState::free);
  EXPECT_FALSE(inTilesWhereSparse(buildDenseField(raster), 0).isTiled()) << "all of it is mapped";
}

// In frames of any shape, with few walls and farther from them than a byte tells.
TEST(ClearBlocks, TellTheWallsOrTheDistanceToTheNearest)
{
  std::mt19937 random(11);
  for (const auto& [width, height] : std::vector<std::pair<std::uint32_t, std::uint32_t>>{
           {1, 1}, {1, 600}, {600, 1}, {2, 7}, {37, 41}, {3, 580}, {64, 64}, {580, 3}})
  {
    DenseField field;
    field.frame = {{0, 0}, 0.05, width, height};
    field.cells.resize(std::size_t{width} * height);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> walls;
    for (std::uint32_t k = random() % 4; k > 0; --k)
    {
      const std::size_t cell = random() % field.cells.size();
      field.cells[cell] = DenseCell(CellState::solid_wall);
      walls.emplace_back(cell % width, cell / width);
    }
    const ClearBlocks blocks(field);
    ASSERT_EQ(blocks.width(), static_cast<std::int32_t>((width + 1) / 2));
    ASSERT_EQ(blocks.height(), static_cast<std::int32_t>((height + 1) / 2));
    const std::int32_t count = blocks.width() * blocks.height();
    for (std::int32_t k = 0; k < count; ++k)
    {
      const std::int32_t column = k % blocks.width();
      const std::int32_t row = k / blocks.width();
      std::int32_t nearest = ClearBlocks::kFarthest;
      std::uint32_t own = 0;
      for (const auto& [x, y] : walls)
      {
        const std::int32_t right = static_cast<std::int32_t>(x / 2) - column;
        const std::int32_t up = static_cast<std::int32_t>(y / 2) - row;
        nearest = std::min(nearest, std::max(std::abs(right), std::abs(up)));
        if (right == 0 && up == 0) own |= ClearBlocks::bitOf(x, y);
      }
      const auto expected =
          own != 0 ? static_cast<std::int32_t>(own) : ClearBlocks::kWalls + nearest;
      ASSERT_EQ(blocks.whole()[k], expected) << width << " x " << height << ", block " << k;
    }
    EXPECT_EQ(blocks.whole()[count], ClearBlocks::kOutside);
  }
}

TEST(FieldTiles, HaveTheSameClearBlocks)
{
  const ClearBlocks whole(corners());
  const ClearBlocks tiled(cornersInTiles());
  ASSERT_TRUE(tiled.isTiled());
  const WideInt steps = {0, 1, 2, 3, 5, 8, 13, 21};
  for (std::int32_t y = 0; y < whole.height(); ++y)
  {
    for (std::int32_t x = 0; x < whole.width(); ++x)
    {
      const WideInt columns = (x + 17 * steps) % whole.width();
      const WideInt rows = (y + 29 * steps) % whole.height();
      WideInt bytes;
      tiled.loadTiled(columns, rows, bytes);
      for (int k = 0; k < 8; ++k)
      {
        ASSERT_EQ(bytes[k], whole.whole()[rows[k] * whole.width() + columns[k]])
            << columns[k] << " " << rows[k];
      }
    }
  }
}

TEST(FieldTiles, AreJudgedLikeTheWholeField)
{
  const DenseScan scan = scanOfCorner();
  ASSERT_GT(scan.size(), 100U);
  const DenseVerifier whole(corners());
  const DenseVerifier tiled(cornersInTiles());
  const WallCrossings whole_crossings(corners());
  const WallCrossings tiled_crossings(cornersInTiles());
  std::mt19937 random(5);
  std::vector<PoseProposal> proposals;
  int crossed = 0;
  for (int k = 0; k < 3000; ++k)
  {
    const TPose2D pose =
        k < 2000 ? anyPose(random) : TPose2D(-0.5 + 1e-3 * (k - 2500), 7.0, 1e-3 * (k - 2500));
    proposals.push_back(
        {static_cast<float>(pose.x), static_cast<float>(pose.y), static_cast<float>(pose.phi)});
    ASSERT_EQ(tiled.evaluate(scan, pose).score, whole.evaluate(scan, pose).score) << pose;
    const std::uint64_t through = whole_crossings.throughBits(scan, pose, 60);
    ASSERT_EQ(tiled_crossings.throughBits(scan, pose, 60), through) << pose;
    crossed += through != 0 ? 1 : 0;
    if (k % 10 == 0)
    {
      ASSERT_EQ(tiled.refine(scan, pose, 5, 64), whole.refine(scan, pose, 5, 64)) << pose;
    }
  }
  EXPECT_GT(crossed, 100);
  MatchingCounters counters;
  const std::vector<RankedPose> a = whole.rank(scan, proposals, 32, counters);
  const std::vector<RankedPose> b = tiled.rank(scan, proposals, 32, counters);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  EXPECT_NEAR(a.front().pose.x, -0.5, 0.1);
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    EXPECT_EQ(a[k].pose, b[k].pose);
    EXPECT_EQ(a[k].evidence.score, b[k].evidence.score);
  }
}
}  // namespace
}  // namespace sigloc
