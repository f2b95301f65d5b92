// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/TrackSet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "matching/dense/DenseVerifier.h"
#include "support/wall_ahead.h"

namespace sigloc
{
namespace
{
/// A track that a relocation has just started, with a given score and number of unexplained
/// observed cells.
Track newcomer(double weight, double score, double unexplained_cells)
{
  constexpr int kCells = 10;
  const DenseScan scan = test::wallAhead(kCells);
  Track track;
  track.hypothesis.weight = weight;
  track.score = score;
  const auto share = static_cast<float>(1.0 - unexplained_cells / static_cast<double>(kCells));
  track.explained.addScan(observedCells(scan, {0, 0, 0}),
                          std::vector<ExplainedReturn>(scan.size(), {share, false, share < 0.5F}),
                          0);
  return track;
}

TrackSet setOf(const std::vector<Track>& tracks)
{
  TrackSet set{TrackerOptions{}};
  set.tracks = tracks;
  set.elsewhere = 0;
  return set;
}

/// A closed room of 8 m x 6 m.
DenseField room()
{
  OccupancyRaster raster;
  raster.frame = {{0, 0}, 0.05, 200, 160};
  for (int y = 0; y < 160; ++y)
  {
    for (int x = 0; x < 200; ++x)
    {
      const bool inside = x >= 20 && x < 180 && y >= 20 && y < 140;
      const bool edge = x >= 18 && x < 182 && y >= 18 && y < 142;
      raster.cells.push_back(inside ? CellState::free
                             : edge ? CellState::solid_wall
                                    : CellState::unknown);
    }
  }
  return buildDenseField(raster);
}

/// The scan from its middle. Of every ten neighbouring returns of a wall, `unmapped` end 2 m before
/// it.
ObservedScene lookAround(int unmapped)
{
  ObservedScene scene;
  scene.sensor_origins = {{0, 0}};
  const auto add = [&](int k, double x, double y)
  {
    const double before = k % 10 < unmapped ? 2.0 / std::hypot(x, y) : 0.0;
    scene.beams.push_back({{x * (1 - before), y * (1 - before)}, 0});
  };
  for (int k = -38; k < 38; ++k)
  {
    add(k + 40, 0.1 * k, 3.025);
    add(k + 40, 0.1 * k, -3.025);
  }
  for (int k = -28; k < 28; ++k)
  {
    add(k + 30, 4.025, 0.1 * k);
    add(k + 30, -4.025, 0.1 * k);
  }
  return scene;
}

TEST(TrackSetRefinement, AScanThatFitsBadlySaysLessOfThePose)
{
  const DenseField field = room();
  const DenseVerifier verifier(field);
  // How far the update corrects a track that odometry has moved 0.1 m too far.
  const auto drawn_back = [&](int unmapped)
  {
    TrackSet set{TrackerOptions{}};
    set.tracks.resize(1);
    GaussianPose& pose = set.tracks[0].hypothesis.pose;
    pose.mean = {5.0, 4.0, 0};
    pose.covariance = mrpt::math::CMatrixDouble33::Zero();
    pose.covariance(0, 0) = pose.covariance(1, 1) = 0.03 * 0.03;
    pose.covariance(2, 2) = 0.01 * 0.01;
    MotionIncrement motion;
    motion.mean = {0.1, 0, 0};
    motion.covariance = mrpt::math::CMatrixDouble33::Zero();
    set.predict(motion);
    set.refineAndScore(makeDenseScan(lookAround(unmapped), 180), verifier);
    return 5.1 - set.tracks[0].hypothesis.pose.mean.x;
  };
  const double well = drawn_back(0);
  EXPECT_GT(well, 0.04);
  EXPECT_GT(drawn_back(3), 0.55 * well) << "by the share that fits, not by its square";
  EXPECT_LT(drawn_back(5), 0.4 * well);
  EXPECT_GT(drawn_back(5), 0);
  EXPECT_NEAR(drawn_back(10), 0, 0.05) << "nothing is explained, and nothing breaks";
}

TEST(TrackSetRefinement, BeamsThroughWallsAreThoseOfThePoseThatIsEvaluated)
{
  const DenseField field = room();
  const DenseVerifier verifier(field);
  std::mt19937 random(71);
  std::uniform_real_distribution<double> off(-0.6, 0.6);
  int measured = 0;
  int passing = 0;
  for (int k = 0; k < 200; ++k)
  {
    TrackSet set{TrackerOptions{}};
    set.tracks.resize(1);
    Track& track = set.tracks[0];
    track.through = ~std::uint64_t{0};
    const mrpt::math::TPose2D start(5 + off(random), 4 + off(random), off(random));
    track.hypothesis.pose.mean = start;
    const double sigma = k % 2 == 0 ? 0.03 : 0.5;
    track.hypothesis.pose.covariance = mrpt::math::CMatrixDouble33::Identity();
    track.hypothesis.pose.covariance *= sigma * sigma;
    MotionIncrement motion;
    motion.covariance = mrpt::math::CMatrixDouble33::Zero();
    set.predict(motion);
    const DenseScan scan = makeDenseScan(lookAround(k % 4), 180);
    set.refineAndScore(scan, verifier);
    EXPECT_EQ(track.through, verifier.beamsThroughWalls(scan, track.evaluated_at));
    measured += track.evaluated_at == start ? 0 : 1;
    passing += track.through != 0 ? 1 : 0;
  }
  EXPECT_GT(measured, 50);
  EXPECT_LT(measured, 200) << "some stay at the prediction";
  EXPECT_GT(passing, 20);
}

TEST(TrackSetRefinement, WithoutOdometryATrackDrivesOnAsItDidAndKeepsItsHeading)
{
  const DenseField field = room();
  const DenseVerifier verifier(field);
  TrackSet set{TrackerOptions{}};
  set.tracks.resize(1);
  GaussianPose& pose = set.tracks[0].hypothesis.pose;
  pose.mean = {4.8, 4.0, 0.1};
  pose.covariance = mrpt::math::CMatrixDouble33::Identity();
  set.predict(std::nullopt);
  EXPECT_NEAR(pose.mean.x, 4.8, 1e-9) << "a new track has not moved yet";
  set.refineAndScore(makeDenseScan(lookAround(0), 180), verifier);
  ASSERT_NEAR(pose.mean.x, 5.0, 0.02);
  const double heading = pose.mean.phi;
  ASSERT_LT(heading, 0.05) << "it has turned back";
  set.predict(std::nullopt);
  EXPECT_NEAR(pose.mean.x, 5.2, 0.03);
  EXPECT_NEAR(pose.mean.phi, heading, 1e-9) << "the turn does not go on";
  const double blind = pose.mean.x;
  for (int step = 0; step < 100; ++step) set.predict(std::nullopt);
  EXPECT_NEAR(pose.mean.x, blind, 1e-9) << "a robot that sees nothing is not sent through walls";
}

TEST(TrackSetStanding, TheFirstTellsWhetherTheRobotIsInTheMap)
{
  TrackSet set = setOf({newcomer(0.9, 1, 0), newcomer(0.1, 1, 0)});
  for (Track& track : set.tracks) track.in_field = true;
  set.tracks[0].confirmed = -1;
  set.tracks[1].confirmed = 12;
  EXPECT_LT(set.probabilityHere(), 0.9);
  std::swap(set.tracks[0].confirmed, set.tracks[1].confirmed);
  EXPECT_GT(set.probabilityHere(), 0.99);
}

/// The odds of "somewhere else" after a relocation that has found a pose without a track, over
/// those before. The only track has the log-odds `confirmed`.
double oddsOfElsewhereGrow(double lead, double confirmed, double probability = 0.5,
                           bool complete = true)
{
  TrackSet set = setOf({newcomer(0.9, 1, 0)});
  set.elsewhere = 0.1;
  set.tracks[0].confirmed = confirmed;
  RelocationResult result;
  result.complete = complete;
  result.candidates.resize(1);
  result.candidates[0].pose.mean = {20, 0, 0};
  result.candidates[0].probability = probability;
  set.weighUntracked(result, lead, 0.5);
  EXPECT_NEAR(set.elsewhere + set.tracks[0].hypothesis.weight, 1, 1e-12);
  return set.elsewhere / set.tracks[0].hypothesis.weight * 9;
}

TEST(WeighUntracked, ALeadCountsByHowFreshItIs)
{
  EXPECT_NEAR(oddsOfElsewhereGrow(1, 0), std::exp(0.5), 1e-9);
  EXPECT_NEAR(oddsOfElsewhereGrow(-1, 0), std::exp(-0.5), 1e-9);
  EXPECT_NEAR(oddsOfElsewhereGrow(1, 0, 0.95, false), 1, 1e-9) << "its pose may have been missed";
}

TEST(WeighUntracked, OnlyAFarBetterPoseSpeaksAgainstATrackThatIsRetained)
{
  EXPECT_NEAR(oddsOfElsewhereGrow(1, 12), 1, 1e-9);
  EXPECT_NEAR(oddsOfElsewhereGrow(-1, 12), std::exp(-0.5), 1e-9);
  EXPECT_NEAR(oddsOfElsewhereGrow(5, 12), std::exp(2.5), 1e-9);
  EXPECT_NEAR(oddsOfElsewhereGrow(0, 12, 0.95), 1, 1e-9);
  EXPECT_NEAR(oddsOfElsewhereGrow(0, 0, 0.95), 3, 1e-9) << "overruled: 0.3 to 0.9";
}

TEST(WeighNewTracks, TheMilderOfScoreAndGroundCounts)
{
  // Worse by score 9 : 1, by observed cells hardly. Then worse by both, by the cells less. Then
  // worse by both, more.
  TrackSet set = setOf({newcomer(0.81, 1, 0), newcomer(0.09, 0.9, 0.2), newcomer(0.09, 0.9, 0.5),
                        newcomer(0.01, 0.8, 6)});
  set.weighNewTracksAmongThemselves();
  const double cost = set.costOfUnexplained();
  const double first = set.tracks[0].hypothesis.weight;
  EXPECT_NEAR(set.tracks[1].hypothesis.weight / first, std::exp(-0.2 * cost), 1e-6);
  EXPECT_NEAR(set.tracks[2].hypothesis.weight / first, std::exp(-0.5 * cost), 1e-6);
  EXPECT_NEAR(set.tracks[3].hypothesis.weight / first, 0.01 / 0.81, 1e-6);
  double sum = 0;
  for (const Track& track : set.tracks) sum += track.hypothesis.weight;
  EXPECT_NEAR(sum, 1.0, 1e-9);
}

TEST(WeighNewTracks, RemembersWhatTheOtherJudgeSaid)
{
  TrackSet set = setOf({newcomer(0.5, 1, 0), newcomer(0.5, 1, 4)});
  set.weighNewTracksAmongThemselves();
  EXPECT_NEAR(set.tracks[1].hypothesis.weight, 0.5, 1e-9);
  EXPECT_NEAR(set.tracks[1].deficit.by_score, 0, 1e-9);
  EXPECT_NEAR(set.tracks[1].deficit.by_cells, -4 * set.costOfUnexplained(), 1e-5);
}

TEST(WeighNewTracks, LeavesTracksAloneThatAreOlder)
{
  TrackSet set = setOf({newcomer(0.6, 1, 0), newcomer(0.3, 0.9, 0.1), newcomer(0.1, 0.8, 0)});
  set.tracks[0].hypothesis.age = 7;
  const double cost = set.costOfUnexplained();
  set.weighNewTracksAmongThemselves();
  EXPECT_EQ(set.tracks[0].hypothesis.weight, 0.6);
  EXPECT_EQ(set.tracks[0].deficit.by_cells, 0);
  EXPECT_NEAR(set.tracks[1].hypothesis.weight + set.tracks[2].hypothesis.weight, 0.4, 1e-9);
  EXPECT_EQ(set.costOfUnexplained(), cost) << "what the place has changed is told by older tracks";
}

TEST(WeighNewTracks, ExpectsChangeWhereTheBestExplainsLittle)
{
  const auto cost_after = [](double score)
  {
    TrackSet set = setOf({newcomer(1, score, 0)});
    set.weighNewTracksAmongThemselves();
    EXPECT_EQ(set.tracks[0].hypothesis.weight, 1);
    return set.costOfUnexplained();
  };
  EXPECT_GT(cost_after(1.0), cost_after(0.9));
  EXPECT_GT(cost_after(0.9), cost_after(0.7));
  EXPECT_NEAR(cost_after(0.1), 0.7 * std::log(0.7 / 0.3), 1e-9) << "clutter counts as change, too";
  EXPECT_EQ(cost_after(0.6), cost_after(0.1));
}

TEST(WeighNewTracks, NoTracksAreNoTrouble)
{
  TrackSet set = setOf({});
  set.weighNewTracksAmongThemselves();
  EXPECT_TRUE(set.tracks.empty());
  set.tracks = {newcomer(0, 1, 0)};
  set.weighNewTracksAmongThemselves();
  EXPECT_EQ(set.tracks[0].hypothesis.weight, 0);
}

TEST(TravelMeter, NoiseAroundOnePoseIsNoTravel)
{
  std::mt19937_64 random(61);
  std::uniform_real_distribution<double> noise(-0.02, 0.02);
  TravelMeter meter;
  for (int step = 0; step < 10000; ++step)
  {
    const mrpt::math::TPose2D pose{noise(random), noise(random), noise(random)};
    EXPECT_EQ(meter.moveTo(pose, TrackerOptions{}).with_turns, 0);
  }
}

TEST(TravelMeter, StepsOfAnySizeCountWhatWasDriven)
{
  const TrackerOptions options;
  for (const double step : {0.01, 0.1, 0.4})
  {
    TravelMeter meter;
    Travel sum;
    for (double x = 0; x < 10; x += step)
    {
      const Travel travel = meter.moveTo({x, 0, x}, options);
      sum.distance += travel.distance;
      sum.with_turns += travel.with_turns;
    }
    EXPECT_NEAR(sum.distance, 10, 0.15 + step);
    EXPECT_NEAR(sum.with_turns, 10 + 10 * options.evidence_distance / options.evidence_turn, 0.6);
  }
}

TEST(TrackSet, StepsWithoutOdometryAreNotCountedAgainByTheNextOneWithIt)
{
  const DenseField field = room();
  const DenseVerifier verifier(field);
  Track track;
  track.hypothesis.pose.mean = {4, 3, 0};
  track.hypothesis.weight = 1;
  TrackSet set = setOf({track});
  for (int step = 0; step < 5; ++step)
  {
    set.predict(std::nullopt);
    set.tracks[0].hypothesis.pose.mean.x += 0.2;
    set.scoreInPlace(makeDenseScan(lookAround(0), 180), verifier);
  }
  EXPECT_EQ(set.predict(MotionIncrement{}).with_turns, 0);
  MotionIncrement motion;
  motion.mean = {0.2, 0, 0};
  EXPECT_NEAR(set.predict(motion).distance, 0.2, 1e-12);
  set.tracks[0].hypothesis.id = 7;
  set.tracks[0].score = 1;
  set.travelToScan(false);
  EXPECT_EQ(set.predict(std::nullopt).distance, TrackerOptions{}.lost_distance);
  EXPECT_EQ(set.travelToScan(false).distance, 0) << "counted by odometry";
}

TEST(TravelToScan, ABlindWayCountsAtTheNextScan)
{
  TrackSet set = setOf({});
  MotionIncrement motion;
  motion.mean = {0.06, 0, 0};
  Travel sum;
  for (int step = 0; step < 100; ++step)
  {
    set.predict(motion);
    if (step % 10 != 9) continue;
    const Travel travel = set.travelToScan(false);
    sum.distance += travel.distance;
    sum.with_turns += travel.with_turns;
  }
  EXPECT_NEAR(sum.with_turns, 6, 0.13);
  EXPECT_LE(sum.distance, 1.2) << "nothing was seen on the rest of the way";
}

TEST(TravelToScan, BlindStepsWithoutOdometryAreNoTravel)
{
  TrackSet set = setOf({Track{}});
  for (int step = 0; step < 10; ++step) set.predict(std::nullopt);
  set.predict(MotionIncrement{});
  EXPECT_EQ(set.travelToScan(false).with_turns, 0);
  EXPECT_EQ(set.travelToScan(true).with_turns, 0);
}

TEST(TravelToScan, WithoutOdometryTheTrackShowsTheMotion)
{
  Track track;
  track.hypothesis.id = 7;
  TrackSet set = setOf({track});
  const auto travel_at = [&](double x, bool doubted)
  {
    set.predict(std::nullopt);
    set.tracks[0].hypothesis.pose.mean = {x, 0, 0};
    return set.travelToScan(doubted).distance;
  };
  EXPECT_EQ(travel_at(0, false), 0) << "nothing to compare with";
  EXPECT_EQ(travel_at(0.05, false), 0);
  EXPECT_NEAR(travel_at(0.2, false), 0.2, 1e-12);
  EXPECT_NEAR(travel_at(0.2, true), TrackerOptions{}.lost_distance, 1e-12);
  EXPECT_NEAR(travel_at(0.4, false), 0.2, 1e-12);
  set.tracks[0].hypothesis.id = 8;
  EXPECT_EQ(travel_at(5, false), 0) << "another track";
}
}  // namespace
}  // namespace sigloc
