// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/wakeup/wakeup_simulated.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "bridge/rawlog_files.h"
#include "support/host_locale.h"

namespace sigloc
{
namespace
{
SimulatedTrackOptions smallOptions()
{
  SimulatedTrackOptions options;
  options.drives = 6;
  options.drives_per_world = 2;
  options.travel = 4;
  options.method.seed = 7;
  return options;
}

/// By value: a loop over a part of the report itself would outlive it.
std::vector<Wakeup> runsOf(const SimulatedTrackOptions& options)
{
  return runSimulatedTrack(options).methods.front().runs;
}

TEST(SimulatedTrack, GivesTheSameStepsOnOneAndTwoThreads)
{
  SimulatedTrackOptions options = smallOptions();
  const WakeupReport one = runSimulatedTrack(options);
  options.threads = 2;
  const WakeupReport two = runSimulatedTrack(options);
  for (std::size_t r = 0; r < options.drives; ++r)
  {
    const Wakeup& a = one.methods.front().runs[r];
    const Wakeup& b = two.methods.front().runs[r];
    EXPECT_EQ(a.group, b.group);
    ASSERT_EQ(a.steps.size(), b.steps.size());
    ASSERT_FALSE(a.steps.empty());
    for (std::size_t i = 0; i < a.steps.size(); ++i)
    {
      EXPECT_EQ(a.steps[i].claim.pose, b.steps[i].claim.pose);
      EXPECT_EQ(a.steps[i].claim.weights, b.steps[i].claim.weights);
      EXPECT_EQ(a.steps[i].claim.confident, b.steps[i].claim.confident);
    }
  }
}

TEST(SimulatedTrack, VisitsAllKindsOfWorldsAndFindsTheRobot)
{
  SimulatedTrackOptions options = smallOptions();
  options.travel = 12;
  const WakeupReport report = runSimulatedTrack(options);
  std::size_t right = 0;
  std::vector<std::string> groups;
  for (const Wakeup& run : report.methods.front().runs)
  {
    right += run.right_at_end;
    if (std::find(groups.begin(), groups.end(), run.group) == groups.end())
    {
      groups.push_back(run.group);
    }
    EXPECT_TRUE(run.steps.back().claim.belief);
  }
  EXPECT_EQ(groups.size(), 3U);
  EXPECT_GE(right, 5U);
}

TEST(SimulatedTrack, JudgesEveryClaimInAForeignMapWrong)
{
  SimulatedTrackOptions options = smallOptions();
  options.foreign = true;
  options.drives = 2;
  options.travel = 8;
  options.methods = {"mcl"};  // which claims with ease
  options.method.particles = 500;
  std::size_t claimed = 0;
  for (const Wakeup& run : runsOf(options))
  {
    EXPECT_FALSE(run.right_at_end);
    claimed += std::count_if(run.steps.begin(), run.steps.end(),
                             [](const WakeupStep& step) { return step.claim.confident; }) > 0;
    for (const WakeupStep& step : run.steps)
    {
      EXPECT_EQ(step.judged, step.claim.confident ? Claim::wrong : Claim::none);
    }
  }
  EXPECT_GT(claimed, 0U);
}

TEST(SimulatedTrack, TellsTheGatesThatClaimsAreJudgedBy)
{
  SimulatedTrackOptions options = smallOptions();
  options.drives = 1;
  const test::TemporaryFolder folder;
  const test::HostLocale host;
  writeWakeupReport(runSimulatedTrack(options), folder.path());
  const std::string text = test::readBytes(folder / "report.md");
  EXPECT_NE(text.find("Wrong: more than 0.5 m or 10 degrees off"), std::string::npos);
}

TEST(SimulatedTrack, CarriesTheRobotToAnotherPlace)
{
  SimulatedTrackOptions options = smallOptions();
  options.drives = 1;
  options.kidnap = true;
  const WakeupReport report = runSimulatedTrack(options);
  const Wakeup& run = report.methods.front().runs.front();
  ASSERT_GT(run.kidnapped_at, 0U);
  EXPECT_EQ(run.steps[run.kidnapped_at].step, 0U) << "the first step of the second drive";
  EXPECT_GE(run.steps.back().travelled, 1.9 * options.travel);
}

struct DriveCounts
{
  std::size_t right = 0;
  std::size_t wrong = 0;  ///< drives with a wrong claim
};

DriveCounts countsOf(const SimulatedTrackOptions& options)
{
  DriveCounts counts;
  for (const Wakeup& run : runsOf(options))
  {
    counts.right += run.right_at_end;
    counts.wrong += run.wrong_steps > 0;
  }
  return counts;
}

TEST(SimulatedTrack, IsSeldomConfidentInForeignMaps)
{
  SimulatedTrackOptions options = smallOptions();
  options.drives = 36;
  options.drives_per_world = 4;
  options.travel = 10;
  options.threads = 2;
  options.foreign = true;
  EXPECT_LE(countsOf(options).wrong, 1U);
}

TEST(SimulatedTrack, FindsTheRobotThroughClutter)
{
  SimulatedTrackOptions options = smallOptions();
  options.kinds = {WorldKind::office, WorldKind::hall};
  options.drives = 16;
  options.drives_per_world = 4;
  options.travel = 10;
  options.threads = 2;
  options.clutter_share = 0.3;
  const DriveCounts counts = countsOf(options);
  EXPECT_GE(counts.right, 14U);
  EXPECT_EQ(counts.wrong, 0U);
}

// In corridors of look-alikes few features come into view that only the right pose explains. There
// the evidence for a pose is how long it has been tracked, eq. (8.22). Moved furniture may support
// a wrong pose as long as it is in view, which counts only once, eq. (8.5).
TEST(SimulatedTrack, BelievesWhatItHasFollowedForLongAmongMovedFurniture)
{
  SimulatedTrackOptions options;
  options.kinds = {WorldKind::corridor};
  options.drives = 20;
  options.drives_per_world = 10;
  options.travel = 20;
  options.method.seed = 2;
  options.moved_share = 0.5;
  options.threads = 2;
  const DriveCounts few = countsOf(options);
  EXPECT_GE(few.right, 17U);
  EXPECT_EQ(few.wrong, 0U);
  options.drives = 200;
  options.drives_per_world = 2;
  options.method.seed = 501;
  const DriveCounts many = countsOf(options);
  EXPECT_GE(many.right, 163U);
  EXPECT_LE(many.wrong, 2U);
}

TEST(SimulatedTrack, FollowsARobotWithoutOdometryThroughItsTurns)
{
  SimulatedTrackOptions options = smallOptions();
  // In a corridor without doors in view the motion along it cannot be observed: not tested here.
  options.kinds = {WorldKind::office, WorldKind::hall};
  options.drives = 16;
  options.drives_per_world = 4;
  options.travel = 10;
  options.threads = 2;
  options.odometry = false;
  const DriveCounts counts = countsOf(options);
  EXPECT_GE(counts.right, 15U);
  EXPECT_EQ(counts.wrong, 0U);
}

/// The squared normalised error of right claims, 3 expected.
struct Honesty
{
  double mean = 0;
  double in_ellipse = 0;  // share within the 95 % gate
};

Honesty honestyOf(const SimulatedTrackOptions& options)
{
  Honesty honesty;
  std::size_t count = 0;
  for (const Wakeup& run : runsOf(options))
  {
    for (const WakeupStep& step : run.steps)
    {
      if (step.judged != Claim::right) continue;
      honesty.mean += step.nees;
      honesty.in_ellipse += step.nees < 7.815 ? 1 : 0;
      ++count;
    }
  }
  EXPECT_GT(count, 500U);
  honesty.mean /= static_cast<double>(count);
  honesty.in_ellipse /= static_cast<double>(count);
  return honesty;
}

TEST(SimulatedTrack, ItsCovariancesAreHonest)
{
  SimulatedTrackOptions options = smallOptions();
  options.drives = 40;
  options.drives_per_world = 1;  // the shift of a map is one draw
  options.travel = 20;
  options.threads = 2;
  const Honesty shifted = honestyOf(options);
  EXPECT_GT(shifted.mean, 2.0);
  EXPECT_LT(shifted.mean, 4.0);
  EXPECT_GT(shifted.in_ellipse, 0.90);
  // A map without any error is better than the map error model assumes.
  options.drives = 36;
  options.drives_per_world = 3;
  options.travel = 8;
  options.map_sigma = 0;
  const Honesty exact = honestyOf(options);
  EXPECT_GT(exact.mean, 1.0);
  EXPECT_LT(exact.mean, 3.0);
  std::cout << "squared normalised error " << shifted.mean << " in shifted maps, " << exact.mean
            << " in exact ones\n";
}

TEST(SimulatedTrack, FindsAndFollowsRobotsThatSeeLandmarksOnly)
{
  SimulatedTrackOptions options = smallOptions();
  options.drives = 20;
  options.drives_per_world = 5;
  options.kinds = {WorldKind::points};
  const WakeupReport report = runSimulatedTrack(options);
  std::size_t right = 0;
  for (const Wakeup& run : report.methods.front().runs)
  {
    right += run.right_at_end;
    EXPECT_EQ(run.wrong_steps, 0U) << "drive " << run.start;
  }
  EXPECT_GE(right, 18U);  // some wake up where a patch of the field repeats
}

TEST(SimulatedTrack, RefusesOptionsThatMakeNoSense)
{
  SimulatedTrackOptions options = smallOptions();
  options.kinds = {WorldKind::points};
  options.methods = {"signature", "mcl"};  // which cannot use landmarks
  EXPECT_THROW(runSimulatedTrack(options), std::invalid_argument);
  options = smallOptions();
  options.mapped_share = 0;
  EXPECT_THROW(runSimulatedTrack(options), std::invalid_argument);
  options = smallOptions();
  options.methods = {"magic"};
  EXPECT_THROW(runSimulatedTrack(options), std::invalid_argument);
}
}  // namespace
}  // namespace sigloc
