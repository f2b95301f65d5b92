// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/DenseVerifier.h"

#include <gtest/gtest.h>

#include <bitset>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "map/RayCaster.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// An L-shaped room of 10 m x 8 m with a block in one corner: nothing about it is symmetric.
class Room
{
 public:
  Room()
  {
    OccupancyRaster raster;
    raster.frame = {{0, 0}, 0.05, 240, 200};
    for (int y = 0; y < 200; ++y)
    {
      for (int x = 0; x < 240; ++x)
      {
        const bool inside = x > 20 && x < 220 && y > 20 && y < 180 && !(x > 140 && y > 120);
        const bool edge = x >= 18 && x <= 222 && y >= 18 && y <= 182;
        raster.cells.push_back(inside ? CellState::free
                               : edge ? CellState::solid_wall
                                      : CellState::unknown);
      }
    }
    field_ = std::make_unique<DenseField>(buildDenseField(raster));
  }

  const DenseField& field() const { return *field_; }

  /// The scan of a laser with 180 beams around the robot; every `clutter`-th beam ends half way.
  ObservedScene scene(const TPose2D& pose, int clutter = 0) const
  {
    const RayCaster rays(*field_);
    ObservedScene scene;
    scene.sensor_origins = {{0, 0}};
    for (int i = 0; i < 180; ++i)
    {
      const double angle = -M_PI + 2 * M_PI * i / 180;
      const auto range = rays.cast({pose.x, pose.y}, pose.phi + angle, 30);
      if (!range) continue;
      const double end = clutter > 0 && i % clutter == 0 ? 0.5 * *range : *range + 0.025;
      scene.beams.push_back({{end * std::cos(angle), end * std::sin(angle)}, 0});
    }
    return scene;
  }

 private:
  std::unique_ptr<DenseField> field_;
};

class LatticeOfPoses : public ::testing::TestWithParam<float>
{
};

TEST_P(LatticeOfPoses, HasTheTrueCellFirst)
{
  const Room room;
  const DenseVerifier verifier(room.field());
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> x(1.6, 6.4);
  std::uniform_real_distribution<double> y(1.6, 5.4);
  std::uniform_real_distribution<double> heading(-M_PI, M_PI);
  std::vector<PoseProposal> lattice;
  for (float px = 1.2F; px < 11; px += GetParam())
  {
    for (float py = 1.2F; py < 9; py += GetParam())
    {
      for (int h = 0; h < 60; ++h) lattice.push_back({px, py, 0.1047F * static_cast<float>(h)});
    }
  }
  for (int k = 0; k < 20; ++k)
  {
    const TPose2D truth(x(random), y(random), heading(random));
    const DenseScan scan = makeDenseScan(room.scene(truth), 400);
    MatchingCounters counters;
    const std::vector<RankedPose> ranked = verifier.rank(scan, lattice, 10, counters);
    ASSERT_FALSE(ranked.empty());
    EXPECT_LE(counters.poses_scored, lattice.size());
    EXPECT_NEAR(ranked.front().pose.x, truth.x, 0.06);
    EXPECT_NEAR(ranked.front().pose.y, truth.y, 0.06);
    EXPECT_NEAR(std::remainder(ranked.front().pose.phi - truth.phi, 2 * M_PI), 0, 0.02);
    EXPECT_GT(ranked.front().evidence.score, 0.85);
  }
}

// Of 0.4 m all are scored on the fine raster, of 0.3 m the rough one thins them.
INSTANTIATE_TEST_SUITE_P(Of, LatticeOfPoses, ::testing::Values(0.4F, 0.3F));

TEST(DenseVerifier, RanksFurtherProposalsBesideThoseBefore)
{
  const Room room;
  const DenseVerifier verifier(room.field());
  const TPose2D truth(3, 2.5, 0.7);
  const DenseScan scan = makeDenseScan(room.scene(truth), 400);
  const std::vector<PoseProposal> near{{3.2F, 2.4F, 0.75F}, {2.8F, 2.6F, 0.65F}};
  const std::vector<PoseProposal> elsewhere{{5, 5, 2}, {2, 5, -1.5F}, {6, 2, 3}};
  MatchingCounters counters;
  const std::vector<RankedPose> right = verifier.rank(scan, near, 10, counters);
  const std::vector<RankedPose> wrong = verifier.rank(scan, elsewhere, 10, counters);
  ASSERT_EQ(right.size(), 1U);
  ASSERT_FALSE(wrong.empty());
  // Whichever come first, the best of all wins, and none of those before is lost. Proposals that
  // lie far behind are not refined any more.
  const std::vector<RankedPose> right_last = verifier.rank(scan, near, 10, counters, wrong);
  EXPECT_EQ(right_last.size(), wrong.size() + 1);
  for (const auto& both : {verifier.rank(scan, elsewhere, 10, counters, right), right_last})
  {
    ASSERT_FALSE(both.empty());
    EXPECT_EQ(both.front().evidence.score, right.front().evidence.score);
    EXPECT_EQ(both.front().pose.x, right.front().pose.x);
  }
  // Each pose is kept once and is not refined anew, and no more are kept than asked for.
  const std::vector<RankedPose> again = verifier.rank(scan, near, 10, counters, right);
  ASSERT_EQ(again.size(), 1U);
  EXPECT_EQ(again.front().pose, right.front().pose);
  EXPECT_EQ(again.front().evidence.score, right.front().evidence.score);
  EXPECT_EQ(verifier.rank(scan, near, 2, counters, wrong).size(), 2U);
  EXPECT_EQ(verifier.rank(scan, {}, 10, counters, right).size(), 1U);
}

TEST(DenseVerifier, CountsBeamsThatPassASolidWall)
{
  const Room room;
  const DenseVerifier verifier(room.field());
  const TPose2D inside(4, 4, 0.3);
  const DenseScan own = makeDenseScan(room.scene(inside), 400);
  EXPECT_EQ(verifier.evaluate(own, inside).through_wall, 0);
  // Every beam reaches 20 m, whatever the room.
  ObservedScene far = room.scene(inside);
  for (BeamEnd& beam : far.beams) beam.point *= 20.0 / beam.point.norm();
  EXPECT_EQ(verifier.evaluate(makeDenseScan(far, 400), inside).through_wall, 1);
  // Very long beams do not take longer.
  ObservedScene endless = room.scene(inside);
  for (BeamEnd& beam : endless.beams) beam.point *= 1e9;
  EXPECT_EQ(verifier.evaluate(makeDenseScan(endless, 400), inside).through_wall, 1);
  // Beams that end a little behind a wall have met it within the margin only.
  ObservedScene behind = room.scene(inside);
  for (BeamEnd& beam : behind.beams) beam.point *= 1 + 0.2 / beam.point.norm();
  EXPECT_EQ(verifier.evaluate(makeDenseScan(behind, 400), inside).through_wall, 0);
  // A robot outside the raster, looking in.
  EXPECT_GT(verifier.evaluate(makeDenseScan(far, 400), {-3, 4, 0}).through_wall, 0.1);
}

// Few returns may be spaced: only their beams count, but others are known to pass walls, too.
TEST(DenseVerifier, EndsAndBeamsMakeTheWholeEvidence)
{
  const Room room;
  const DenseVerifier verifier(room.field());
  ObservedScene scene = room.scene({4, 4, 0.3});
  for (std::size_t k = 0; k < scene.beams.size(); k += 3) scene.beams[k].point *= 1.5;
  DenseScan scan = makeDenseScan(scene, 180);
  const TPose2D pose(4.1, 3.9, 0.25);
  const std::bitset<64> through(verifier.beamsThroughWalls(scan, pose));
  ASSERT_GT(through.count(), 10U);
  ASSERT_LT(through.count(), 54U);
  for (std::size_t spaced = 1; spaced <= scan.size(); ++spaced)
  {
    scan.spaced = spaced;
    const DenseEvidence whole = verifier.evaluate(scan, pose);
    DenseEvidence evidence = verifier.evaluateEnds(scan, pose);
    EXPECT_EQ(evidence.through_wall, 0);
    EXPECT_GE(evidence.score, whole.score);
    verifier.testRays(scan, pose, evidence);
    EXPECT_EQ(evidence.score, whole.score);
    EXPECT_EQ(evidence.through, through.to_ullong());
    std::size_t crossed = 0;
    const std::size_t counted = std::min<std::size_t>(64, spaced);
    for (std::size_t k = 0; k < counted; ++k) crossed += through[k] ? 1 : 0;
    EXPECT_DOUBLE_EQ(whole.through_wall,
                     static_cast<double>(crossed) / static_cast<double>(counted));
  }
}

// A proposal in the border of the coarse field once made the verifier read beyond its cells.
TEST(DenseVerifier, ScoresNoProposalOffTheMap)
{
  const Room room;
  const DenseVerifier verifier(room.field());
  const DenseScan scan = makeDenseScan(room.scene({4, 4, 0.3}), 400);
  std::vector<PoseProposal> around;
  for (const float far : {-30.0F, -11.0F, -5.0F, 15.0F, 23.0F, 60.0F})
  {
    for (const float along : {-11.0F, 4.0F, 21.0F})
    {
      for (const float phi : {0.0F, 1.6F, 3.1F, 4.7F})
      {
        around.push_back({far, along, phi});
        around.push_back({along, far, phi});
      }
    }
  }
  MatchingCounters counters;
  EXPECT_TRUE(verifier.rank(scan, around, 10, counters).empty());
  EXPECT_EQ(counters.poses_scored, 0U);
}

TEST(DenseVerifier, LoneReturnsInFreeSpaceSayNothing)
{
  const Room room;
  const DenseVerifier verifier(room.field());
  const TPose2D pose(4, 4, 0.3);
  const DenseEvidence clean = verifier.evaluate(makeDenseScan(room.scene(pose), 400), pose);
  const DenseEvidence specks = verifier.evaluate(makeDenseScan(room.scene(pose, 4), 400), pose);
  EXPECT_NEAR(specks.score, clean.score, 0.02);
  EXPECT_EQ(specks.in_free, 0);
  // Half of the room hidden by something large is no speck.
  ObservedScene hidden = room.scene(pose);
  for (std::size_t i = 0; i < hidden.beams.size() / 2; ++i) hidden.beams[i].point *= 0.5;
  EXPECT_GT(verifier.evaluate(makeDenseScan(hidden, 400), pose).in_free, 0.4);
}

/// (8.26) at one return, written down once more; beams that pass walls left out.
double explainedAt(const DenseField& field, const TPoint2D& end)
{
  const RasterFrame& frame = field.frame;
  const double column = (end.x - frame.origin.x) / frame.resolution;
  const double row = (end.y - frame.origin.y) / frame.resolution;
  if (column < 0 || row < 0 || column >= frame.width || row >= frame.height) return 0;
  const DenseCell& cell =
      field.cells[static_cast<std::size_t>(row) * frame.width + static_cast<std::size_t>(column)];
  if (cell.distance() == DenseCell::kFar) return 0;
  const auto likelihood = [](double distance, double sigma)
  { return std::exp(-0.5 * distance * distance / (sigma * sigma)); };
  const double from_cell = cell.distance() * DenseField::kDistanceUnit;
  const double from_ridge = std::hypot(
      (column - std::floor(column) - 0.5) * frame.resolution - cell.dx * DenseField::kOffsetUnit,
      (row - std::floor(row) - 0.5) * frame.resolution - cell.dy * DenseField::kOffsetUnit);
  const bool in_free = from_cell > 0.4 && cell.state() == CellState::free;
  return std::max(0.0, 0.65 * 0.5 * (likelihood(from_cell, 0.12) + likelihood(from_cell, 0.25)) +
                           0.35 * likelihood(from_ridge, 0.06) - (in_free ? 0.5 : 0.0));
}

TEST(DenseVerifier, ReturnsAreExplainedAsSharplyAsTheScoreSays)
{
  const Room room;
  const double blur = std::sqrt(0.06 * 0.06 - 0.055 * 0.055);  // a sharp sigma of 0.06 m, (6.14)
  const DenseVerifier verifier(room.field(), blur);
  const TPose2D truth(3.0, 3.5, 0.4);
  const DenseScan scan = makeDenseScan(room.scene(truth, 9), 180);
  const auto mean_at = [&](const TPose2D& pose)
  {
    const std::vector<ExplainedReturn> explained =
        verifier.explainedReturns(scan, pose, verifier.beamsThroughWalls(scan, pose));
    EXPECT_EQ(explained.size(), scan.size());
    double sum = 0;
    for (std::size_t i = 0; i < explained.size(); ++i)
    {
      const auto share = static_cast<double>(explained[i].share);
      const double of_end =
          explainedAt(room.field(), pose.composePoint(TPoint2D(scan.x[i], scan.y[i])));
      const double passing_walls = std::max(0.0, of_end - 0.5);
      EXPECT_TRUE(std::abs(share - of_end) < 2e-4 || std::abs(share - passing_walls) < 2e-4)
          << share << " is not " << of_end << ", return " << i;
      sum += share;
    }
    return sum / static_cast<double>(scan.size());
  };
  const TPose2D aside(3.07, 3.57, 0.4);
  const double lost_score =
      verifier.evaluate(scan, truth).score - verifier.evaluate(scan, aside).score;
  EXPECT_GT(lost_score, 0);
  EXPECT_GT(mean_at(truth) - mean_at(aside), 0.4 * lost_score);
  // One in nine ends in free space. The others are explained as well as cells of 5 cm allow.
  EXPECT_LE(mean_at(truth), 8.0 / 9.0);
  EXPECT_GE(mean_at(truth), 8.0 / 9.0 - 0.042);
  EXPECT_LT(mean_at({7.5, 3.5, 0.4}), 0.6);
}

/// A corridor of 40 m x 2 m.
DenseField corridorField()
{
  OccupancyRaster raster;
  raster.frame = {{0, 0}, 0.05, 800, 60};
  for (int y = 0; y < 60; ++y)
  {
    for (int x = 0; x < 800; ++x)
    {
      const bool inside = y > 10 && y < 50;
      const bool edge = y >= 8 && y <= 52;
      raster.cells.push_back(inside ? CellState::free
                             : edge ? CellState::solid_wall
                                    : CellState::unknown);
    }
  }
  return buildDenseField(raster);
}

/// Returns of both walls within `reach` [m] to either side of a robot in the middle. Only the left
/// wall is given as a feature. The returns of the other wall seem to fix the pose in both
/// directions.
ObservedScene betweenTwoWalls(double reach)
{
  ObservedScene scene;
  scene.sensor_origins = {{0, 0}};
  Feature left;
  left.type = FeatureType::segment;
  left.position = {0, 1};
  left.direction = -M_PI / 2;
  left.size = 2 * reach;
  scene.features = {left};
  for (double x = -reach; x < reach; x += 0.1)
  {
    scene.beams.push_back({{x, 1.0}, 0});
    scene.beams.push_back({{x, -1.0}, 0});
  }
  return scene;
}

TEST(DenseVerifier, ABareCorridorFixesNoPoseAlongIt)
{
  const DenseField field = corridorField();
  const DenseVerifier verifier(field);
  const DenseScan scan = makeDenseScan(betweenTwoWalls(4), 180);
  for (const double heading : {0.0, M_PI})
  {
    const TPose2D pose(20, 1.5, heading);
    EXPECT_LT(std::sqrt(verifier.covarianceAt(scan, pose)(0, 0)), 0.03);
    const auto tested = verifier.testedCovarianceAt(scan, pose);
    EXPECT_GT(std::sqrt(tested(0, 0)), 0.09);
    EXPECT_NEAR(tested(1, 1), verifier.covarianceAt(scan, pose)(1, 1), 1e-6);
    EXPECT_EQ(tested(2, 2), verifier.covarianceAt(scan, pose)(2, 2));
  }
}

TEST(DenseVerifier, WhatTheFitBearsOutStaysAsItIs)
{
  const Room room;
  const DenseVerifier verifier(room.field());
  for (const TPose2D& truth : {TPose2D(3, 3.5, 0.4), TPose2D(2.2, 6.5, -1.2), TPose2D(6, 2, 3.0)})
  {
    const DenseScan scan = makeDenseScan(room.scene(truth), 180);
    const auto plain = verifier.covarianceAt(scan, truth);
    const auto tested = verifier.testedCovarianceAt(scan, truth);
    for (int axis = 0; axis < 2; ++axis)
    {
      EXPECT_GE(tested(axis, axis), plain(axis, axis));
      EXPECT_LT(tested(axis, axis), 4.0 * plain(axis, axis));
    }
  }
}
}  // namespace
}  // namespace sigloc
