// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/wall_ahead.h"

namespace sigloc
{
namespace
{
/// One that a dense field backs, followed for a while.
Track followed()
{
  Track track;
  track.confirmed = 3;
  track.followed = 2;
  track.misfit = 0.02;
  track.followed_way = 15;
  return track;
}

TEST(TrackStanding, ARivalThatIsNearlyAsGoodTakesFromIt)
{
  const Track track = followed();
  EXPECT_EQ(track.standing(1e-4), track.standing(0));
  EXPECT_NEAR(track.standing(0) - track.standing(1e-2), 0.6 * std::log(100), 1e-9);
  double last = track.standing(1e-4);
  for (double next = 2e-4; next < 0.5; next *= 2)
  {
    EXPECT_LT(track.standing(next), last) << next;
    last = track.standing(next);
  }
}

TEST(TrackStanding, WhatWasLeftOverStandsLessThanWhatWasFound)
{
  Track track = followed();
  const double found = track.standing(0);
  track.behind = {-4, -30};
  EXPECT_EQ(track.standing(0), found) << "the milder judge took no more than chance does";
  track.behind = {-30, -9};
  EXPECT_NEAR(found - track.standing(0), 0.2 * 5, 1e-9);
}

TEST(TrackStanding, RelocationsThatFindOtherPlacesTakeFromIt)
{
  const auto standing_after = [](int found, int missed)
  {
    Track track = followed();
    for (int k = 0; k < found; ++k) track.noteRelocation(true);
    for (int k = 0; k < missed; ++k) track.noteRelocation(false);
    return track.standing(0);
  };
  const double before = followed().standing(0);
  EXPECT_EQ(standing_after(0, 3), before) << "three may all be chance";
  EXPECT_EQ(standing_after(5, 5), before);
  EXPECT_NEAR(standing_after(2, 3), before - 1, 1e-9);
  EXPECT_NEAR(standing_after(3, 7), before - 2, 1e-9);
  EXPECT_NEAR(standing_after(0, 40), before - 2, 1e-9);
}

TEST(TrackStanding, LastingIsEvidenceWhereTheGroundIsExplained)
{
  Track track = followed();
  track.followed_way = 10;
  const double young = track.standing(0);
  EXPECT_NEAR(young, track.presence(), 1e-9);
  track.followed_way = 20;
  EXPECT_NEAR(track.standing(0) - young, 6.5, 1e-9);
  track.followed_way = 100;
  EXPECT_NEAR(track.standing(0) - young, 6.5, 1e-9);
}

TEST(TrackStanding, LastingTellsNothingWhereMuchOfTheGroundIsUnexplained)
{
  const auto survived = [](float explained_share)
  {
    const DenseScan scan = testing::wallAhead(10);
    const std::vector<float> explained(scan.size(), explained_share);
    Track track = followed();
    track.followed_way = 20;
    track.explained.look(viewOf(scan, {0, 0, 0}), explained, 0);
    return track.standing(0) - track.presence();
  };
  EXPECT_NEAR(survived(0.9F), 6.5, 1e-6);
  EXPECT_NEAR(survived(0.825F), 3.25, 1e-4);
  EXPECT_NEAR(survived(0.75F), 0, 1e-6);
}

TEST(TrackStanding, WithoutADenseFieldPresenceIsAll)
{
  Track track = followed();
  track.misfit.reset();
  track.behind = {-30, -30};
  EXPECT_EQ(track.standing(0.4), track.presence());
}
}  // namespace
}  // namespace sigloc
