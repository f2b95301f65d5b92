// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/Track.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/wall_ahead.h"

namespace sigloc
{
namespace
{
/// One that a dense field backs, tracked for a while.
Track tracked()
{
  Track track;
  track.in_field = true;
  track.confirmed = 3;
  track.tracked_log_odds = 2;
  track.tracked_distance = 15;
  return track;
}

/// The log-odds of a track that has driven `way` [m], of whose 20 mapped cells `off_walls` are not
/// explained, and that relocations have `found`.
double logOddsAfter(double way, int off_walls, double found = tracked().confirmed)
{
  constexpr int kCells = 20;
  const DenseScan scan = test::wallAhead(kCells);
  std::vector<ExplainedReturn> explained;
  for (std::size_t i = 0; i < scan.size(); ++i)
  {
    const bool off = static_cast<int>(i * kCells / scan.size()) < off_walls;
    explained.push_back({off ? 0.0F : 1.0F, false, off});
  }
  Track track = tracked();
  track.tracked_distance = way;
  track.confirmed = found;
  track.explained.addScan(observedCells(scan, {0, 0, 0}), explained, 0);
  return track.inMapLogOdds();
}

TEST(TrackInMap, RelocationsAndTheWayAddUp)
{
  Track more = tracked();
  more.confirmed += 2;
  const double by_relocations = more.inMapLogOdds() - tracked().inMapLogOdds();
  EXPECT_GT(by_relocations, 1);
  more.tracked_log_odds += 2;
  EXPECT_GT(more.inMapLogOdds() - tracked().inMapLogOdds(), by_relocations);
}

TEST(TrackInMap, LastingIsEvidenceWhereWhatIsSeenIsExplained)
{
  EXPECT_GT(logOddsAfter(20, 0), logOddsAfter(10, 0) + 1);
  EXPECT_EQ(logOddsAfter(100, 0), logOddsAfter(20, 0)) << "twenty metres tell all";
}

// In clutter much is unexplained at the right pose, too. Relocations tell it from a wrong one.
TEST(TrackInMap, WhereMuchIsUnexplainedLastingIsEvidenceForWhatRelocationsFind)
{
  EXPECT_NEAR(logOddsAfter(20, 5, 0), logOddsAfter(0, 5, 0), 1e-9) << "never found";
  EXPECT_LT(logOddsAfter(20, 5, -1), logOddsAfter(0, 5, -1)) << "relocations contradict it";
  double last = 0;
  for (const double found : {1.0, 2.0, 4.6})
  {
    const double gain = logOddsAfter(20, 5, found) - logOddsAfter(0, 5, found);
    EXPECT_GT(gain, last) << found;
    last = gain;
  }
  EXPECT_NEAR(logOddsAfter(20, 5, 12) - logOddsAfter(0, 5, 12), last, 1e-9) << "sure is sure";
}

TEST(TrackInMap, APoseFoundLateIsLessSure)
{
  Track late = tracked();
  late.searched_distance = 10;
  EXPECT_LT(late.inMapLogOdds(), tracked().inMapLogOdds() - 0.5);
  Track later = late;
  later.searched_distance = 20;
  EXPECT_LT(later.inMapLogOdds(), late.inMapLogOdds() - 0.5);
  Track latest = later;
  latest.searched_distance = 200;
  EXPECT_EQ(latest.inMapLogOdds(), later.inMapLogOdds()) << "twenty metres tell all";
}

TEST(TrackInMap, WhatIsUnexplainedSpeaksAgainstIt)
{
  for (const double way : {0.0, 20.0})
  {
    for (const double found : {-1.0, 3.0, 12.0})
    {
      for (int k = 0; k < 20; ++k)
        EXPECT_GT(logOddsAfter(way, k, found), logOddsAfter(way, k + 1, found)) << k;
    }
  }
}

// What the map does not hold says nothing about whether this is the map.
TEST(TrackInMap, UnknownAreaCountsNeitherWay)
{
  const DenseScan scan = test::wallAhead(20);
  Track track = tracked();
  track.explained.addScan(observedCells(scan, {0, 0, 0}),
                          std::vector<ExplainedReturn>(scan.size(), {0.0F, true, false}), 0);
  EXPECT_EQ(track.inMapLogOdds(), tracked().inMapLogOdds());
}

// Landmarks that fit by chance add up: what was found must be more than sure.
TEST(TrackInMap, OfLandmarksIsLessSureThanWhatIsPaired)
{
  Track track = tracked();
  track.in_field = false;
  double last = -100;
  for (const double paired : {-1.0, 0.0, 4.6, 8.0, 12.0})
  {
    track.confirmed = paired;
    EXPECT_GT(track.inMapLogOdds(), last);
    EXPECT_LT(track.inMapLogOdds(), paired);
    last = track.inMapLogOdds();
  }
  EXPECT_GT(last, 4.6) << "a track can be sure";
}
}  // namespace
}  // namespace sigloc
