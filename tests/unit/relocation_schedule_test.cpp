// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/RelocationSchedule.h"

#include <gtest/gtest.h>

#include "support/wall_ahead.h"
#include "tracking/tracks/confirmation.h"

namespace sigloc
{
namespace
{
/// A relocation that has ended at its budget with nothing found.
RelocationResult cutShort()
{
  RelocationResult result;
  result.complete = false;
  return result;
}

RelocationResult answered(bool complete)
{
  RelocationResult result;
  result.complete = complete;
  result.verdict = complete ? Verdict::not_here : Verdict::ambiguous;
  if (!complete) result.candidates.resize(1);
  return result;
}

TEST(RelocationSchedule, WhatWasCutShortWithNothingFoundIsNoAnswer)
{
  const TrackerOptions options;
  RelocationSchedule schedule(options);
  EXPECT_TRUE(schedule.isDue(false));
  EXPECT_FALSE(schedule.noteResult(cutShort()));
  EXPECT_TRUE(schedule.isWakingUp());
  EXPECT_EQ(schedule.freshShare(), 1.0);
  EXPECT_FALSE(schedule.hasSearchedAll());
  EXPECT_FALSE(schedule.isDue(false)) << "it would cost as much again";
  EXPECT_TRUE(schedule.isDue(true));
  schedule.countTravel({0, options.relocation_distance});
  EXPECT_TRUE(schedule.isDue(false));
  EXPECT_TRUE(schedule.noteResult(answered(true)));
  EXPECT_FALSE(schedule.isWakingUp());
  EXPECT_TRUE(schedule.hasSearchedAll());
}

TEST(RelocationSchedule, ASightOfTooLittleIsTriedAgainAtOnce)
{
  RelocationSchedule schedule(TrackerOptions{});
  EXPECT_FALSE(schedule.noteResult(RelocationResult{}));
  EXPECT_TRUE(schedule.isDue(false));
}

TEST(RelocationSchedule, PosesOfASearchThatWasCutShortAreNoSearchOfAll)
{
  RelocationSchedule schedule(TrackerOptions{});
  EXPECT_TRUE(schedule.noteResult(answered(false)));
  EXPECT_FALSE(schedule.isWakingUp());
  EXPECT_FALSE(schedule.hasSearchedAll());
}

TEST(ConfirmTracks, ASearchThatWasCutShortSaysNothingOfWhatItDidNotFind)
{
  const DenseScan scan = test::wallAhead(10);
  const auto confirmed_after = [&](bool complete)
  {
    TrackSet set{TrackerOptions{}};
    set.tracks.resize(1);
    set.tracks[0].confirmed = 3;
    set.tracks[0].score = 0.2;
    RelocationResult result = answered(complete);
    result.candidates.resize(1);
    result.candidates[0].pose.mean = {20, 0, 0};
    result.candidates[0].score = 0.5;
    confirmTracks(set, result, scan, 0, 1);
    return set.tracks[0].confirmed;
  };
  EXPECT_LT(confirmed_after(true), 3);
  EXPECT_EQ(confirmed_after(false), 3);
}
}  // namespace
}  // namespace sigloc
