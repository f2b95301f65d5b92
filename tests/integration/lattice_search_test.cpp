// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/lattice/lattice_search.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "support/small_office.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;

OccupancyRaster tinyRaster()
{
  OccupancyRaster raster;
  raster.frame = {{-1.0, 2.0}, 0.1, 40, 30};
  raster.cells.assign(40 * 30, CellState::free);
  for (std::size_t ix = 5; ix < 30; ++ix) raster.cells[20 * 40 + ix] = CellState::wall;
  for (std::size_t iy = 8; iy < 21; ++iy) raster.cells[iy * 40 + 5] = CellState::wall;
  return raster;
}

std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>> keysOf(
    const std::vector<LatticePose>& poses)
{
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>> keys;
  keys.reserve(poses.size());
  for (const LatticePose& p : poses) keys.emplace_back(p.score, p.heading, p.row, p.column);
  return keys;
}

// The score by its definition: likelihood of the distance to the nearest wall cell, cell by cell.
std::uint32_t scoreByDefinition(const OccupancyRaster& raster, const DenseSearchSpace& space,
                                const LatticePose& pose, const std::vector<TPoint2D>& points)
{
  std::uint32_t score = 0;
  for (const CellOffset& o : space.offsets(points, pose.heading))
  {
    const int ix = space.columnCells()[pose.column] + o.dx;
    const int iy = space.rowCells()[pose.row] + o.dy;
    const auto width = static_cast<int>(raster.frame.width);
    const auto height = static_cast<int>(raster.frame.height);
    if (ix < 0 || iy < 0 || ix >= width || iy >= height) continue;
    double nearest = 1e9;
    for (int wy = 0; wy < height; ++wy)
    {
      for (int wx = 0; wx < width; ++wx)
      {
        if (raster.cells[static_cast<std::size_t>(wy * width + wx)] != CellState::wall) continue;
        nearest = std::min(nearest, std::hypot(wx - ix, wy - iy));
      }
    }
    const double d = std::round(nearest * raster.frame.resolution / DenseField::kDistanceUnit) *
                     DenseField::kDistanceUnit;
    if (d >= DenseCell::kFar * DenseField::kDistanceUnit) continue;
    const double ratio = d / space.options().coarse_sigma;
    score += static_cast<std::uint32_t>(std::lround(255 * std::exp(-0.5 * ratio * ratio)));
  }
  return score;
}

TEST(LatticeSearch, ExhaustiveScoresFollowTheirDefinition)
{
  const OccupancyRaster raster = tinyRaster();
  DenseSearchOptions options;
  options.headings = 12;
  options.lattice_step = 0.3;
  options.refined = 1000000;  // keep every pose
  const DenseSearchSpace space(raster, options);
  const std::vector<TPoint2D> points = {{1.0, 0.2}, {0.4, -0.7}, {-0.9, 0.1}, {90.0, 0.0}};
  const LatticeSearchResult found = searchExhaustively(space, points);
  const auto free_places =
      static_cast<std::size_t>(std::count(space.freePlaces().begin(), space.freePlaces().end(), 1));
  ASSERT_EQ(found.best.size(), free_places * options.headings);
  EXPECT_EQ(found.poses_scored, free_places * options.headings);
  EXPECT_TRUE(std::is_sorted(found.best.begin(), found.best.end(), ranksBefore));
  for (std::size_t i = 0; i < found.best.size(); i += 17)
  {
    EXPECT_EQ(found.best[i].score, scoreByDefinition(raster, space, found.best[i], points));
  }
}

TEST(LatticeSearch, BranchAndBoundFindsTheSamePosesAsTheExhaustiveSearch)
{
  const test::SmallOffice office = test::makeSmallOffice(7, 12);
  const OccupancyRaster raster = test::searchRaster(office);
  for (const double step : {0.2, 0.27})
  {
    DenseSearchOptions options;
    options.lattice_step = step;
    const DenseSearchSpace space(raster, options);
    const BranchAndBoundSearch branch_and_bound(space);
    for (const PosedScans& query : office.queries)
    {
      const auto points = space.latticePoints(query.scans);
      const LatticeSearchResult all = searchExhaustively(space, points);
      const LatticeSearchResult pruned = branch_and_bound.search(points);
      EXPECT_EQ(keysOf(all.best), keysOf(pruned.best));
      EXPECT_LT(pruned.poses_scored, all.poses_scored);
    }
  }
}

TEST(LatticeSearch, FindsTheQueriesOfAnOffice)
{
  const test::SmallOffice office = test::makeSmallOffice(3, 20);
  const DenseSearchSpace space(test::searchRaster(office), {});
  std::size_t right = 0;
  for (const PosedScans& query : office.queries)
  {
    const auto found = searchExhaustively(space, space.latticePoints(query.scans));
    const auto candidates = space.refineAndRank(found.best, query.scans);
    ASSERT_FALSE(candidates.empty());
    const auto& pose = candidates.front().pose.mean;
    const auto& truth = query.map_from_robot;
    if (std::hypot(pose.x - truth.x, pose.y - truth.y) < 0.1 &&
        std::abs(mrpt::math::angDistance(pose.phi, truth.phi)) < 0.03)
    {
      ++right;
    }
    for (std::size_t i = 1; i < candidates.size(); ++i)
    {
      EXPECT_LE(candidates[i].score, candidates[i - 1].score);
    }
  }
  EXPECT_GE(right, 19U);
}

TEST(LatticeSearch, KeepsToTheRegion)
{
  const test::SmallOffice office = test::makeSmallOffice(3, 1);
  DenseSearchOptions options;
  options.region = PoseRegion{2, 6, 3, 7, 1.0, 0.2};
  const DenseSearchSpace space(test::searchRaster(office), options);
  const auto points = space.latticePoints(office.queries.front().scans);
  for (const LatticePose& found : searchExhaustively(space, points).best)
  {
    const auto pose = space.poseOf(found);
    EXPECT_TRUE(pose.x >= 2 && pose.x <= 6 && pose.y >= 3 && pose.y <= 7);
    EXPECT_LE(std::abs(pose.phi - 1.0), 0.2);
  }
  options.region = PoseRegion{1e6, 2e6, 1e6, 2e6, 0, 4};
  EXPECT_THROW(DenseSearchSpace(test::searchRaster(office), options), std::invalid_argument);
}
}  // namespace
}  // namespace sigloc
