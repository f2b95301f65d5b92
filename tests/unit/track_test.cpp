// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/Track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/wall_ahead.h"

namespace sigloc
{
namespace
{
/// Whole scans are left unexplained, so that (8.29) adds nothing.
constexpr ClaimContext kCluttered = {0, 5, 1};

/// One that a dense field backs, tracked_log_odds for a while.
Track tracked_log_odds()
{
  Track track;
  track.confirmed = 3;
  track.tracked_log_odds = 2;
  track.misfit = 0.02;
  track.tracked_distance = 15;
  return track;
}

TEST(TrackStanding, ARivalThatIsNearlyAsGoodTakesFromIt)
{
  const Track track = tracked_log_odds();
  EXPECT_EQ(track.claimLogOdds({1e-4}), track.claimLogOdds({}));
  EXPECT_NEAR(track.claimLogOdds({}) - track.claimLogOdds({1e-2}), 0.6 * std::log(100), 1e-9);
  double last = track.claimLogOdds({1e-4});
  for (double next = 2e-4; next < 0.5; next *= 2)
  {
    EXPECT_LT(track.claimLogOdds({next}), last) << next;
    last = track.claimLogOdds({next});
  }
}

TEST(TrackStanding, WhatWasLeftOverStandsLessThanWhatWasFound)
{
  Track track = tracked_log_odds();
  const double found = track.claimLogOdds({});
  track.deficit = {-4, -30};
  EXPECT_EQ(track.claimLogOdds({}), found) << "the milder judge took no more than chance does";
  track.deficit = {-30, -9};
  EXPECT_NEAR(found - track.claimLogOdds({}), 0.2 * 5, 1e-9);
}

TEST(TrackStanding, RelocationsThatFindOtherPlacesTakeFromIt)
{
  const auto standing_after = [](int found, int missed)
  {
    Track track = tracked_log_odds();
    for (int k = 0; k < found; ++k) track.noteRelocation(true);
    for (int k = 0; k < missed; ++k) track.noteRelocation(false);
    return track.claimLogOdds({});
  };
  const double before = tracked_log_odds().claimLogOdds({});
  EXPECT_EQ(standing_after(0, 3), before) << "three may all be chance";
  EXPECT_EQ(standing_after(5, 5), before);
  EXPECT_NEAR(standing_after(2, 3), before - 1, 1e-9);
  EXPECT_NEAR(standing_after(3, 7), before - 2, 1e-9);
  EXPECT_NEAR(standing_after(0, 40), before - 2, 1e-9);
}

TEST(TrackStanding, LastingIsEvidenceWhereTheGroundIsExplained)
{
  Track track = tracked_log_odds();
  track.tracked_distance = 10;
  const double young = track.claimLogOdds({});
  EXPECT_NEAR(young, track.inMapLogOdds(), 1e-9);
  track.tracked_distance = 20;
  EXPECT_NEAR(track.claimLogOdds({}) - young, 6.5, 1e-9);
  track.tracked_distance = 100;
  EXPECT_NEAR(track.claimLogOdds({}) - young, 6.5, 1e-9);
}

TEST(TrackStanding, LastingTellsNothingWhereMuchOfTheGroundIsUnexplained)
{
  const auto survived = [](float explained_share)
  {
    const DenseScan scan = testing::wallAhead(10);
    const std::vector<ExplainedReturn> explained(scan.size(), {explained_share, false, false});
    Track track = tracked_log_odds();
    track.tracked_distance = 20;
    track.explained.addScan(observedCells(scan, {0, 0, 0}), explained, 0);
    return track.claimLogOdds(kCluttered) - track.inMapLogOdds();
  };
  EXPECT_NEAR(survived(0.9F), 6.5, 1e-6);
  EXPECT_NEAR(survived(0.825F), 3.25, 1e-4);
  EXPECT_NEAR(survived(0.75F), 0, 1e-6);
}

/// What (8.29) adds to the claim of a track that explains a share of what it sees.
double forThings(int cells, float explained_share, const ClaimContext& now, double way = 15)
{
  const DenseScan scan = testing::wallAhead(cells);
  Track track = tracked_log_odds();
  track.tracked_distance = way;
  track.explained.addScan(
      observedCells(scan, {0, 0, 0}),
      std::vector<ExplainedReturn>(scan.size(), {explained_share, false, false}), 0);
  return track.claimLogOdds(now) - track.claimLogOdds(kCluttered);
}

TEST(TrackStanding, TheSameShareIsMoreThingsWhereTheRobotSeesFar)
{
  EXPECT_NEAR(forThings(20, 1.0F, {0, 5, 0}), 1.5, 1e-4);
  EXPECT_NEAR(forThings(20, 0.9F, {0, 1, 0}), 1.5, 1e-4);
  EXPECT_NEAR(forThings(20, 0.9F, {0, 2, 0}), 0.8, 1e-4);
  EXPECT_NEAR(forThings(20, 0.9F, {0, 4, 0}), -2.4, 1e-4);
  EXPECT_NEAR(forThings(20, 0.9F, {0, 7, 0}), -4, 1e-4);
  EXPECT_NEAR(forThings(20, 0.95F, {0, 30, 0}), -2.4, 1e-4) << "far enough is far";
}

TEST(TrackStanding, ThingsSpeakAgainstATrackAtOnceAndForItByAndBy)
{
  const ClaimContext far = {0, 7, 0};
  EXPECT_NEAR(forThings(20, 1.0F, far, 0), 0, 1e-4);
  EXPECT_NEAR(forThings(20, 1.0F, far, 5), 0.5, 1e-4);
  EXPECT_NEAR(forThings(20, 1.0F, far, 30), 1.5, 1e-4);
  for (const double way : {0.0, 5.0, 30.0}) EXPECT_NEAR(forThings(20, 0.9F, far, way), -4, 1e-4);
}

TEST(TrackStanding, ThingsTellLittleInClutterOrWhereFewWereSeen)
{
  const double full = forThings(20, 0.9F, {0, 4, 0.15});
  EXPECT_NEAR(full, -2.4, 1e-4);
  EXPECT_NEAR(forThings(20, 0.9F, {0, 4, 0.2}), full / 2, 1e-4);
  EXPECT_NEAR(forThings(20, 0.9F, {0, 4, 0.25}), 0, 1e-4);
  EXPECT_NEAR(forThings(7, 0.9F, {0, 4, 0}), full / 2, 1e-4);
  EXPECT_NEAR(forThings(20, 0.76F, {0, 8, 0}), -4, 1e-4);
  EXPECT_NEAR(forThings(20, 0.7F, {0, 8, 0}), -2, 1e-3) << "clutter of the ground, not of scans";
  EXPECT_NEAR(forThings(20, 0.65F, {0, 8, 0}), 0, 1e-4);
  EXPECT_EQ(tracked_log_odds().claimLogOdds({0, 4, 0}), tracked_log_odds().claimLogOdds(kCluttered))
      << "nothing seen";
}

TEST(TrackStanding, WithoutADenseFieldPresenceIsAll)
{
  Track track = tracked_log_odds();
  track.misfit.reset();
  track.deficit = {-30, -30};
  EXPECT_EQ(track.claimLogOdds({0.4}), track.inMapLogOdds());
}
}  // namespace
}  // namespace sigloc
