// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/wakeup/wakeup.h"

#include <gtest/gtest.h>

#include <set>

#include "bridge/rawlog_files.h"
#include "eval/wakeup/wakeup_drive.h"

namespace sigloc
{
namespace
{
WakeupStep stepOf(double travelled, Claim judged, bool truth = true)
{
  WakeupStep step;
  step.travelled = travelled;
  step.seconds = 0.5 * travelled;
  step.judged = judged;
  step.claim.confident = judged != Claim::none;
  step.claim.has_pose = true;
  step.time_ms = 100;
  if (truth) step.error = {judged == Claim::right ? 0.1 : 5.0, 0};
  return step;
}

TEST(WakeupScoring, SettlesWhereItStaysConfidentToTheEnd)
{
  Wakeup run;
  run.steps = {stepOf(0, Claim::none), stepOf(1, Claim::wrong), stepOf(2, Claim::wrong),
               stepOf(3, Claim::none), stepOf(4, Claim::wrong), stepOf(5, Claim::right),
               stepOf(6, Claim::right)};
  judgeRun(run);
  EXPECT_TRUE(run.right_at_end);
  ASSERT_TRUE(run.settled_after);
  EXPECT_EQ(run.settled_after->metres, 4.0);
  EXPECT_EQ(run.settled_after->seconds, 2.0);
  EXPECT_NEAR(run.cpu_to_settled, 0.5, 1e-12);
  EXPECT_EQ(run.wrong_steps, 3U);
  EXPECT_EQ(run.wrong_episodes, 2U);
}

// A claim outside the mapped area is wrong wherever it is. It is another kind of error than a wrong
// claim inside it.
TEST(WakeupScoring, CountsWrongClaimsOffTheMappedLandApart)
{
  Wakeup run;
  run.steps = {stepOf(0, Claim::right), stepOf(1, Claim::wrong), stepOf(2, Claim::wrong)};
  run.steps.back().mapped = false;
  judgeRun(run);
  EXPECT_EQ(run.wrong_steps, 2U);
  EXPECT_EQ(run.wrong_mapped_steps, 1U);

  WakeupReport report;
  report.methods.emplace_back();
  report.methods.back().name = "signature";
  Wakeup& outside = report.methods.back().runs.emplace_back();
  outside.steps = run.steps;
  outside.steps[1].mapped = false;
  judgeRun(outside);
  EXPECT_NE(wakeupTable(report).find("| 1          | 0              | 2 "), std::string::npos)
      << wakeupTable(report);
}

TEST(WakeupScoring, LandThatIsNotMappedSettlesNothing)
{
  Wakeup run;
  run.steps = {stepOf(0, Claim::none), stepOf(1, Claim::none), stepOf(2, Claim::none)};
  run.steps.back().mapped = false;
  judgeRun(run);
  EXPECT_FALSE(run.settled_after.has_value());
  run.steps.push_back(stepOf(3, Claim::right));
  judgeRun(run);
  ASSERT_TRUE(run.settled_after);
  EXPECT_EQ(run.settled_after->metres, 3.0);
}

// Logs often have truth at some scans only.
TEST(WakeupScoring, StepsWithoutTruthAreMappedWhereThoseAroundThemAre)
{
  const auto steps = [](const std::string& letters)  // m: mapped, o: not, -: without truth
  {
    std::vector<detail::WakeupDriveStep> made;
    for (const char letter : letters)
    {
      detail::WakeupDriveStep step;
      if (letter != '-') step.truth = mrpt::math::TPose2D(1, 2, 3);
      step.mapped = letter != 'o';
      made.push_back(step);
    }
    return made;
  };
  const auto marked = [&](const std::string& letters)
  {
    auto made = steps(letters);
    detail::markStepsWithoutTruth(made);
    std::string all;
    for (const auto& step : made) all += step.mapped ? 'm' : 'o';
    return all;
  };
  EXPECT_EQ(marked("-m--m-o--m-o-"), "mmmmmoooomooo");
  EXPECT_EQ(marked("---"), "mmm");
  EXPECT_EQ(marked("o-"), "oo");
  EXPECT_EQ(marked(""), "");
}

TEST(WakeupScoring, ARunThatNeverSettlesCostsItsWholeTime)
{
  Wakeup run;
  run.steps = {stepOf(0, Claim::right), stepOf(1, Claim::none)};
  judgeRun(run);
  EXPECT_FALSE(run.settled_after.has_value());
  EXPECT_FALSE(run.right_at_end);
  EXPECT_NEAR(run.cpu_to_settled, 0.2, 1e-12);
}

TEST(WakeupScoring, TellsWhenAKidnappingIsNoticed)
{
  Wakeup run;
  run.steps = {stepOf(0, Claim::right), stepOf(1, Claim::right), stepOf(1, Claim::wrong),
               stepOf(2, Claim::wrong), stepOf(3, Claim::none),  stepOf(5, Claim::right)};
  run.kidnapped_at = 2;
  judgeRun(run);
  ASSERT_TRUE(run.noticed_after && run.settled_after);
  EXPECT_EQ(run.noticed_after->metres, 2.0);
  EXPECT_EQ(run.noticed_after->seconds, 1.0);
  EXPECT_EQ(run.settled_after->metres, 4.0) << "counted from the kidnapping";
  EXPECT_EQ(run.settled_after->seconds, 2.0);
  EXPECT_NEAR(run.cpu_to_settled, 0.4, 1e-12);
  EXPECT_EQ(run.wrong_steps, 2U);
  EXPECT_TRUE(isFailedRun(run)) << "it was wrong, though right in the end";
}

TEST(WakeupScoring, WhoNeverNoticesAKidnappingNeverSettles)
{
  Wakeup run;
  run.steps = {stepOf(0, Claim::right), stepOf(1, Claim::right), stepOf(1, Claim::wrong),
               stepOf(2, Claim::wrong)};
  run.kidnapped_at = 2;
  judgeRun(run);
  EXPECT_FALSE(run.noticed_after || run.settled_after);
  EXPECT_TRUE(isFailedRun(run));
}

TEST(WakeupScoring, WhoIsRightAtOnceHasNoticedAtOnce)
{
  Wakeup run;
  run.steps = {stepOf(0, Claim::right), stepOf(1, Claim::right), stepOf(1, Claim::right)};
  run.kidnapped_at = 2;
  judgeRun(run);
  ASSERT_TRUE(run.noticed_after && run.settled_after);
  EXPECT_EQ(run.noticed_after->metres, 0.0);
  EXPECT_EQ(run.settled_after->metres, 0.0) << "not since it woke up";
  EXPECT_FALSE(isFailedRun(run));
}

WakeupOptions officeOptions()
{
  const std::filesystem::path source = SIGLOC_SOURCE_DIR;
  WakeupOptions options;
  options.map = source / "maps" / "office.simplemap";
  options.rawlog = source / "rawlogs" / "office.rawlog";
  options.ground_truth = source / "rawlogs" / "office-truth.txt";
  options.starts = 3;
  options.travel = 2;
  options.methods = {"signature", "mcl"};
  return options;
}

TEST(Track, AsksNoPlaceTwice)
{
  WakeupOptions options = officeOptions();
  options.methods = {"signature"};
  options.travel = 43;
  options.starts = 1000000;
  std::size_t places = 0;
  try
  {
    runWakeups(options);
    FAIL() << "more starts than places";
  }
  catch (const std::runtime_error& error)
  {
    const std::string message = error.what();
    const std::string before = "has only ";
    const auto at = message.find(before);
    ASSERT_NE(at, std::string::npos) << message;
    places = std::stoul(message.substr(at + before.size()));
  }
  ASSERT_GE(places, 2U);
  options.starts = static_cast<std::uint32_t>(places);
  std::set<std::size_t> starts;
  const WakeupReport report = runWakeups(options);
  for (const Wakeup& run : report.methods.front().runs) starts.insert(run.start);
  EXPECT_EQ(starts.size(), places);
}

TEST(Track, DrivesApartShareNoStepAndLeaveNoRoomForOneMore)
{
  WakeupOptions options = officeOptions();
  options.methods = {"signature"};
  options.apart = true;
  options.travel = 5;
  const WakeupReport report = runWakeups(options);
  const auto& runs = report.methods.front().runs;
  ASSERT_GE(runs.size(), 5U);
  std::size_t free_from = 0;
  double driven = 0;
  for (const Wakeup& run : runs)
  {
    EXPECT_EQ(run.start, free_from) << "all of the office is mapped: no step is left out";
    EXPECT_GT(run.steps.back().travelled, 4.0);
    EXPECT_LE(run.steps.back().travelled, 5.0 + 1e-6);
    free_from = run.steps.back().step + 1;
    driven += run.steps.back().travelled;
  }
  options.travel = driven;
  EXPECT_EQ(runWakeups(options).methods.front().runs.size(), 1U);
  options.kidnap = true;
  options.starts = 2;
  EXPECT_THROW(runWakeups(options), std::invalid_argument) << "carried onto another's steps";
}

TEST(Track, GivesTheSameStepsOnOneAndTwoThreads)
{
  WakeupOptions options = officeOptions();
  const WakeupReport one = runWakeups(options);
  options.threads = 2;
  const WakeupReport two = runWakeups(options);
  ASSERT_EQ(one.methods.size(), 2U);
  for (std::size_t m = 0; m < one.methods.size(); ++m)
  {
    for (std::size_t r = 0; r < one.methods[m].runs.size(); ++r)
    {
      const auto& a = one.methods[m].runs[r].steps;
      const auto& b = two.methods[m].runs[r].steps;
      ASSERT_EQ(a.size(), b.size());
      ASSERT_FALSE(a.empty());
      for (std::size_t i = 0; i < a.size(); ++i)
      {
        EXPECT_EQ(a[i].claim.pose, b[i].claim.pose);
        EXPECT_EQ(a[i].claim.confident, b[i].claim.confident);
      }
    }
  }
}

TEST(Track, FindsTheRobotOfTheOffice)
{
  WakeupOptions options = officeOptions();
  options.methods = {"signature"};
  options.kidnap = true;
  options.travel = 5;
  const WakeupReport report = runWakeups(options);
  for (const Wakeup& run : report.methods.front().runs)
  {
    EXPECT_TRUE(run.right_at_end) << "woken up at step " << run.start;
    EXPECT_TRUE(run.noticed_after.has_value());
  }
}

TEST(Track, RunsParticleFiltersWithTheNumberAskedFor)
{
  WakeupOptions options = officeOptions();
  options.methods = {"signature-mcl", "mcl"};
  options.starts = 1;
  options.method.particles = 200;
  const WakeupReport few = runWakeups(options);
  EXPECT_TRUE(few.methods[0].runs.front().right_at_end) << "200 started by signatures do";
  options.method.particles = 4000;
  const WakeupReport more = runWakeups(options);
  for (std::size_t m = 0; m < 2; ++m)
  {
    EXPECT_NE(few.methods[m].runs.front().steps.back().claim.pose,
              more.methods[m].runs.front().steps.back().claim.pose);
  }
}

TEST(Track, EveryClaimInAForeignMapIsWrong)
{
  WakeupOptions options = officeOptions();
  options.methods = {"signature"};
  options.foreign = true;
  options.ground_truth.clear();
  options.travel = 5;
  options.keep_failures = 2;
  // The map is of the drive's own office, so that it is sure to claim something.
  const WakeupReport report = runWakeups(options);
  const WakeupMethodReport& method = report.methods.front();
  std::size_t claims = 0;
  for (const Wakeup& run : method.runs)
  {
    EXPECT_FALSE(run.right_at_end);
    EXPECT_GE(run.steps.back().travelled, 4.5) << "by the odometry";
    for (const WakeupStep& step : run.steps)
    {
      EXPECT_EQ(step.judged, step.claim.confident ? Claim::wrong : Claim::none);
      claims += step.claim.confident;
    }
  }
  EXPECT_GT(claims, 0U);
  ASSERT_EQ(method.failures.size(), 2U);
  EXPECT_FALSE(method.failures.front().record.truth);
  EXPECT_FALSE(method.failures.front().query.scans.empty());
}

TEST(Track, RefusesWhatIsNoKidnapping)
{
  WakeupOptions options = officeOptions();
  options.kidnap = true;
  options.starts = 1;
  EXPECT_THROW(runWakeups(options), std::invalid_argument) << "to its own place";
  options.starts = 2;
  options.foreign = true;
  EXPECT_THROW(runWakeups(options), std::invalid_argument) << "nothing to notice";
}

TEST(Track, RefusesALogThatIsTooShort)
{
  WakeupOptions options = officeOptions();
  options.travel = 1e6;
  EXPECT_THROW(runWakeups(options), std::runtime_error);
  options.starts = 0;
  EXPECT_THROW(runWakeups(options), std::invalid_argument);
}

// Two steps that waited in a buffer were stamped when it was emptied: the truth at the times of the
// next ones is that of other steps.
TEST(Track, StepsStampedBeforeEarlierOnesHaveNoTruth)
{
  const test::TemporaryFolder folder;
  std::vector<mrpt::serialization::CSerializable::Ptr> log;
  for (const double time : {100.0, 100.5, 101.6, 101.8, 101.0, 101.7, 102.5, 103.0})
  {
    log.push_back(test::makeScan(time));
  }
  test::writeObjects(folder / "log.rawlog", log);
  test::writeText(folder / "truth.txt",
                  "100 0 0 0\n100.5 .2 0 0\n101.6 .4 0 0\n101.8 .6 0 0\n102.5 .8 0 0\n"
                  "103 1 0 0\n");
  WakeupOptions options = officeOptions();
  options.rawlog = folder / "log.rawlog";
  options.ground_truth = folder / "truth.txt";
  options.methods = {"signature"};
  options.starts = 1;
  options.travel = 0.9;
  const WakeupReport report = runWakeups(options);
  const auto& steps = report.methods.front().runs.front().steps;
  ASSERT_GE(steps.size(), 7U);
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    EXPECT_EQ(std::isnan(steps[i].error.distance), i == 4 || i == 5) << "step " << i;
  }
}

TEST(Track, NamesALandmarkLogThatItCannotRead)
{
  WakeupOptions options;
  options.methods = {"signature"};
  options.landmarks = "no-such-set";
  options.landmark_folder = "/nowhere";
  EXPECT_THROW(runWakeups(options), std::invalid_argument);
  options.landmarks = "dlr";
  EXPECT_THROW(runWakeups(options), std::runtime_error);
}
}  // namespace
}  // namespace sigloc
