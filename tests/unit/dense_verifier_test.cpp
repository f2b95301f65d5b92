// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/matching/DenseVerifier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "sigloc/map/RayCaster.h"

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

  /// What a laser of 180 beams around the robot sees; every `clutter`-th beam ends half way.
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

TEST(DenseVerifier, RanksTheTrueCellOfALatticeFirst)
{
  const Room room;
  const DenseVerifier verifier(room.field());
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> x(1.6, 6.4);
  std::uniform_real_distribution<double> y(1.6, 5.4);
  std::uniform_real_distribution<double> heading(-M_PI, M_PI);
  std::vector<PoseProposal> lattice;
  for (float px = 1.2F; px < 11; px += 0.4F)
  {
    for (float py = 1.2F; py < 9; py += 0.4F)
    {
      for (int h = 0; h < 60; ++h) lattice.push_back({px, py, 0.1047F * static_cast<float>(h)});
    }
  }
  for (int k = 0; k < 20; ++k)
  {
    const TPose2D truth(x(random), y(random), heading(random));
    const DenseScan scan = makeDenseScan(room.scene(truth), 400);
    std::uint64_t scored = 0;
    const std::vector<RankedPose> ranked = verifier.rank(scan, lattice, 10, scored);
    ASSERT_FALSE(ranked.empty());
    EXPECT_LE(scored, lattice.size());
    EXPECT_NEAR(ranked.front().pose.x, truth.x, 0.06);
    EXPECT_NEAR(ranked.front().pose.y, truth.y, 0.06);
    EXPECT_NEAR(std::remainder(ranked.front().pose.phi - truth.phi, 2 * M_PI), 0, 0.02);
    EXPECT_GT(ranked.front().evidence.score, 0.85);
  }
}

TEST(DenseVerifier, RanksFurtherProposalsBesideThoseBefore)
{
  const Room room;
  const DenseVerifier verifier(room.field());
  const TPose2D truth(3, 2.5, 0.7);
  const DenseScan scan = makeDenseScan(room.scene(truth), 400);
  const std::vector<PoseProposal> near{{3.2F, 2.4F, 0.75F}, {2.8F, 2.6F, 0.65F}};
  const std::vector<PoseProposal> elsewhere{{5, 5, 2}, {2, 5, -1.5F}, {6, 2, 3}};
  std::uint64_t scored = 0;
  const std::vector<RankedPose> right = verifier.rank(scan, near, 10, scored);
  const std::vector<RankedPose> wrong = verifier.rank(scan, elsewhere, 10, scored);
  ASSERT_EQ(right.size(), 1U);
  ASSERT_FALSE(wrong.empty());
  // Whichever come first, the best of all wins, and none is lost.
  for (const auto& both : {verifier.rank(scan, elsewhere, 10, scored, right),
                           verifier.rank(scan, near, 10, scored, wrong)})
  {
    ASSERT_EQ(both.size(), wrong.size() + 1);
    EXPECT_EQ(both.front().evidence.score, right.front().evidence.score);
    EXPECT_EQ(both.front().pose.x, right.front().pose.x);
  }
  // One place counts once, and no more are kept than asked for.
  EXPECT_EQ(verifier.rank(scan, near, 10, scored, right).size(), 1U);
  EXPECT_EQ(verifier.rank(scan, near, 2, scored, wrong).size(), 2U);
  EXPECT_EQ(verifier.rank(scan, {}, 10, scored, right).size(), 1U);
}

TEST(DenseVerifier, CountsBeamsThatPassASolidWall)
{
  const Room room;
  const DenseVerifier verifier(room.field());
  const TPose2D inside(4, 4, 0.3);
  const DenseScan own = makeDenseScan(room.scene(inside), 400);
  EXPECT_EQ(verifier.evaluate(own, inside).through_wall, 0);
  // Every beam reaches 20 m, whatever stands there.
  ObservedScene far = room.scene(inside);
  for (BeamEnd& beam : far.beams) beam.point *= 20.0 / beam.point.norm();
  EXPECT_EQ(verifier.evaluate(makeDenseScan(far, 400), inside).through_wall, 1);
  // Nor does it take forever how far they go.
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

// Read beyond the raster of the first look, when a proposal in its border was looked at.
TEST(DenseVerifier, LooksAtNoProposalOffTheMap)
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
  std::uint64_t scored = 0;
  EXPECT_TRUE(verifier.rank(scan, around, 10, scored).empty());
  EXPECT_EQ(scored, 0U);
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
}  // namespace
}  // namespace sigloc
