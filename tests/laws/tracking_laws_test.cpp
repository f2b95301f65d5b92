// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "eval/process/run_parallel.h"
#include "sigloc/tracking/HypothesisTracker.h"
#include "support/followed_drive.h"
#include "support/simulated_office.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;
using test::confidentlyWrong;
using test::driveThrough;
using test::expectWellFormed;
using test::follow;
using test::isRight;
using test::kOfficeSeed;
using test::MappedWorld;
using test::office;
using test::officeWorld;
using test::Outcome;

constexpr std::uint64_t kForeignSeed = 78;

TEST(Tracker, WakesUpInTwentyOffices)
{
  constexpr std::size_t kOffices = 20;
  std::vector<Outcome> outcomes(kOffices);
  runParallel(kOffices, 2,
              [&](std::size_t k)
              {
                const std::uint64_t seed = 2000 + k;
                const MappedWorld world(officeWorld(seed), seed);
                HypothesisTracker tracker(world.matcher());
                outcomes[k] = follow(tracker, driveThrough(world.world(), 12, seed));
              });
  int right = 0;
  int wrong = 0;
  for (const Outcome& outcome : outcomes)
  {
    right += outcome.right_at_end;
    wrong += outcome.wrong_while_confident;
  }
  std::cout << "wake-ups: " << right << " of " << kOffices << " right at the end, " << wrong
            << " confidently wrong at any step\n";
  EXPECT_EQ(right, 20);
  EXPECT_EQ(wrong, 0);
}

TEST(Tracker, IsDeterministicAndStaysFiniteFor200Steps)
{
  const auto drive = driveThrough(office().world(), 55, 31);
  ASSERT_GE(drive.size(), 200U);
  HypothesisTracker one(office().matcher());
  HypothesisTracker other(office().matcher());
  for (const DriveStep& step : drive)
  {
    const ObservedScene scene = observeScene({*step.scan});
    const Belief& a = one.step(step.motion, scene);
    const Belief& b = other.step(step.motion, scene);
    ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
    EXPECT_EQ(a.elsewhere, b.elsewhere);
    EXPECT_EQ(a.verdict, b.verdict);
    for (std::size_t i = 0; i < a.hypotheses.size(); ++i)
    {
      EXPECT_EQ(a.hypotheses[i].weight, b.hypotheses[i].weight);
      EXPECT_EQ(a.hypotheses[i].pose.mean, b.hypotheses[i].pose.mean);
    }
    expectWellFormed(a);
  }
  EXPECT_TRUE(isRight(one.belief().hypotheses.front().pose.mean, drive.back().world_from_robot));
}

TEST(Tracker, CovarianceIsHonestWhileTracking)
{
  const auto drive = driveThrough(office().world(), 40, 32);
  HypothesisTracker tracker(office().matcher());
  double sum = 0;
  int count = 0;
  for (const DriveStep& step : drive)
  {
    const Belief& belief = tracker.step(step.motion, observeScene({*step.scan}));
    if (belief.verdict != Verdict::localized) continue;
    sum += squaredMahalanobisDistance(belief.hypotheses.front().pose, {step.world_from_robot, {}});
    ++count;
  }
  ASSERT_GT(count, 50);
  std::cout << "tracking: mean squared normalised error " << sum / count << " over " << count
            << " steps\n";
  // Includes the map's common error, which a simulated map does not have: below 3, never above 4.
  EXPECT_LT(sum / count, 4.0);
  EXPECT_GT(sum / count, 0.02);
}

TEST(Tracker, WorksWithoutOdometry)
{
  int right = 0;
  int wrong = 0;
  for (std::uint64_t seed = 41; seed < 45; ++seed)
  {
    HypothesisTracker tracker(office().matcher());
    const Outcome outcome = follow(tracker, driveThrough(office().world(), 12, seed), false);
    right += outcome.right_at_end;
    wrong += outcome.wrong_while_confident;
  }
  std::cout << "without odometry: " << right << " of 4 right, " << wrong << " wrong\n";
  EXPECT_EQ(right, 4);
  EXPECT_EQ(wrong, 0);
}

TEST(Tracker, NoticesAKidnap)
{
  int noticed = 0;
  int right = 0;
  for (std::uint64_t seed = 61; seed < 67; ++seed)
  {
    HypothesisTracker tracker(office().matcher());
    const auto before = driveThrough(office().world(), 10, seed);
    const auto after = driveThrough(office().world(), 12, seed + 100);
    follow(tracker, before);
    const TPose2D& from = before.back().world_from_robot;
    const TPose2D& to = after.front().world_from_robot;
    ASSERT_FALSE(isRight(from, to));
    double travelled = 0;
    bool was_noticed = false;
    int late_wrong = 0;
    for (const DriveStep& step : after)
    {
      travelled += std::hypot(step.motion.mean.x, step.motion.mean.y);
      const Belief& belief = tracker.step(step.motion, observeScene({*step.scan}));
      expectWellFormed(belief);
      const bool wrong = confidentlyWrong(belief, step.world_from_robot);
      if (!wrong && travelled < 2) was_noticed = true;
      if (wrong && travelled > 2) ++late_wrong;
    }
    noticed += was_noticed;
    EXPECT_EQ(late_wrong, 0) << "seed " << seed;
    // The way before the kidnap does not make the new pose one that was found late.
    EXPECT_LT(tracker.evidence().searched, 5) << "seed " << seed;
    right += tracker.belief().verdict == Verdict::localized &&
             isRight(tracker.belief().hypotheses.front().pose.mean, after.back().world_from_robot);
  }
  std::cout << "kidnaps: " << noticed << " of 6 noticed within 2 m, " << right << " right again\n";
  EXPECT_EQ(noticed, 6);
  EXPECT_GE(right, 5);
}

TEST(Tracker, NoticesAKidnapInTheStepAfterItsFirst)
{
  int claimed = 0;
  for (std::uint64_t seed = 201; seed < 221; ++seed)
  {
    const auto drive = driveThrough(office().world(), 12, seed);
    HypothesisTracker tracker(office().matcher());
    const auto seen = [&](const DriveStep& step)
    { return tracker.step(MotionIncrement{}, observeScene({*step.scan})); };
    claimed += seen(drive.front()).verdict == Verdict::localized;
    if (isRight(drive.front().world_from_robot, drive.back().world_from_robot)) continue;
    EXPECT_FALSE(confidentlyWrong(seen(drive.back()), drive.back().world_from_robot))
        << "seed " << seed;
  }
  EXPECT_GE(claimed, 15);
}

// Where it stands then is not in the map, so that no relocation finds it.
TEST(Tracker, DoubtsAKidnapForAsLongAsTheRobotStands)
{
  const World elsewhere = makeWorld(WorldKind::office, {}, 77);
  int before = 0;
  int after = 0;
  for (std::uint64_t seed = 301; seed < 321; ++seed)
  {
    HypothesisTracker tracker(office().matcher());
    follow(tracker, driveThrough(office().world(), 3, seed));
    before += tracker.belief().verdict == Verdict::localized;
    const auto there = driveThrough(elsewhere, 1, seed).front();
    for (int scan = 0; scan < 40; ++scan)
    {
      tracker.step(MotionIncrement{}, observeScene({*there.scan}));
      after += tracker.belief().verdict == Verdict::localized;
    }
  }
  EXPECT_GE(before, 15);
  EXPECT_EQ(after, 0);
}

/// Four people around the robot, each of whom hides a twelfth of the view.
void crowd(LaserScan& scan)
{
  const std::size_t n = scan.ranges.size();
  for (std::size_t person = 0; person < 4; ++person)
  {
    const float distance = 0.7F + 0.3F * static_cast<float>(person);
    const std::size_t first = person * n / 4;
    for (std::size_t i = first; i < first + n / 12; ++i)
    {
      scan.ranges[i] = std::min(scan.ranges[i], distance);
    }
  }
}

TEST(Tracker, ACrowdDoesNotUnsettleIt)
{
  int localized = 0;
  int stays = 0;
  for (std::uint64_t seed = 61; seed < 71; ++seed)
  {
    HypothesisTracker tracker(office().matcher());
    auto drive = driveThrough(office().world(), 12, seed);
    DriveStep last = drive.back();
    drive.pop_back();
    if (!follow(tracker, drive).right_at_end) continue;
    ++localized;
    crowd(*last.scan);
    const Belief& belief = tracker.step(last.motion, observeScene({*last.scan}));
    EXPECT_FALSE(confidentlyWrong(belief, last.world_from_robot)) << "seed " << seed;
    stays += belief.verdict == Verdict::localized;
  }
  EXPECT_GE(localized, 8);
  EXPECT_GE(stays, localized - 1);
}

TEST(Tracker, ClutterInAWideHallDoesNotUnsettleIt)
{
  WorldOptions wide;
  wide.width = 40;
  wide.height = 25;
  const MappedWorld hall(makeWorld(WorldKind::hall, wide, 7), 7);
  LaserOptions cluttered = MappedWorld::laser();
  cluttered.clutter_share = 0.75;
  const LaserSimulator simulator(hall.world(), cluttered);
  int steps = 0;
  int localized = 0;
  for (std::uint64_t seed = 71; seed < 77; ++seed)
  {
    const auto drive = driveThrough(hall.world(), 24, seed);
    const std::vector<DriveStep> before(drive.begin(), drive.begin() + drive.size() / 2);
    HypothesisTracker tracker(hall.matcher());
    if (!follow(tracker, before).right_at_end) continue;
    Random random(seed);
    for (std::size_t k = before.size(); k < drive.size(); ++k)
    {
      const LaserScan scan = simulator.scan(drive[k].world_from_robot, random);
      const Belief& belief = tracker.step(drive[k].motion, observeScene({scan}));
      EXPECT_FALSE(confidentlyWrong(belief, drive[k].world_from_robot)) << "seed " << seed;
      ++steps;
      localized += belief.verdict == Verdict::localized;
    }
  }
  std::cout << "clutter in a hall: localized in " << localized << " of " << steps << " steps\n";
  EXPECT_GE(steps, 100);
  EXPECT_GE(localized, 0.8 * steps);
}

TEST(Tracker, InAForeignMapItIsSeldomLocalized)
{
  int drives = 0;
  for (std::uint64_t seed = 71; seed < 77; ++seed)
  {
    const MappedWorld foreign(officeWorld(seed), seed);
    HypothesisTracker tracker(foreign.matcher());
    drives += follow(tracker, driveThrough(office().world(), 12, seed)).confident_steps > 0;
  }
  std::cout << "foreign maps: " << drives << " of 6 drives confident at some step\n";
  // A bare room of one office fits a bare room of another, however many scans are taken.
  EXPECT_LE(drives, 1);
}

TEST(Tracker, InAForeignMapPosesAreFoundLate)
{
  const MappedWorld foreign(officeWorld(kForeignSeed), kForeignSeed);
  HypothesisTracker tracker(foreign.matcher());
  double driven = 0;
  double most_searched = 0;
  bool localized = false;
  for (const DriveStep& step : driveThrough(office().world(), 25, kForeignSeed))
  {
    driven += step.motion.mean.norm();
    const Belief& belief = tracker.step(step.motion, observeScene({*step.scan}));
    localized |= belief.verdict == Verdict::localized;
    const InMapEvidence evidence = tracker.evidence();
    EXPECT_LE(evidence.searched + evidence.followed, driven + 1e-9);
    most_searched = std::max(most_searched, evidence.searched);
  }
  ASSERT_FALSE(localized);
  EXPECT_GT(most_searched, 5) << "poses come and go";
}

TEST(Tracker, OffTheMappedAreaItIsNotConfidentlyWrong)
{
  // Only the west half is mapped; the drive goes on to the east.
  auto scans = simulateMapping(office().world(), 1.2, 0.35, MappedWorld::laser(), kOfficeSeed);
  scans.erase(std::remove_if(scans.begin(), scans.end(),
                             [](const PosedScans& posed) { return posed.map_from_robot.x > 9; }),
              scans.end());
  // Far returns may come from the other half, so they are cut off, too.
  for (PosedScans& posed : scans)
  {
    for (LaserScan& scan : posed.scans)
    {
      for (std::size_t i = 0; i < scan.ranges.size(); ++i) scan.valid[i] &= scan.ranges[i] < 6.0F;
    }
  }
  const auto matcher =
      std::make_shared<SignatureMatcher>(std::make_shared<FeatureMap>(buildMapFromScans(scans)));
  int wrong_steps = 0;
  int steps_outside = 0;
  int confident_outside = 0;
  for (std::uint64_t seed = 81; seed < 85; ++seed)
  {
    HypothesisTracker tracker(matcher);
    for (const DriveStep& step : driveThrough(office().world(), 40, seed))
    {
      const Belief& belief = tracker.step(step.motion, observeScene({*step.scan}));
      expectWellFormed(belief);
      const bool outside = step.world_from_robot.x > 15;
      steps_outside += outside;
      confident_outside += outside && belief.verdict == Verdict::localized;
      wrong_steps += confidentlyWrong(belief, step.world_from_robot);
    }
  }
  std::cout << "off the map: " << wrong_steps << " confidently wrong steps; outside "
            << steps_outside << " steps, localized in " << confident_outside << "\n";
  EXPECT_GT(steps_outside, 10);
  EXPECT_EQ(wrong_steps, 0);
}
}  // namespace
}  // namespace sigloc
