// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/wakeup/wakeup_drive.h"

#include <algorithm>
#include <cmath>

#include "eval/process/cpu_time.h"
#include "eval/wakeup/own_process.h"

namespace sigloc::detail
{
namespace
{
void judge(const WakeupDriveStep& step, bool foreign, const AccuracyGates& gates,
           WakeupStep& record)
{
  const TrackingClaim& claim = record.claim;
  record.mapped = step.mapped;
  if (foreign)
  {
    if (claim.confident) record.judged = Claim::wrong;
    return;
  }
  if (!step.truth || !claim.has_pose) return;
  record.error = errorBetween(claim.pose, *step.truth);
  if (claim.confident) record.judged = judgeClaim(record.error, gates);
  for (std::size_t k = 0; k < std::min<std::size_t>(claim.hypotheses, claim.poses.size()); ++k)
  {
    record.tracked |= judgeClaim(errorBetween(claim.poses[k], *step.truth), gates) == Claim::right;
  }
  if (claim.belief) record.nees = squaredNormalisedError(claim, *step.truth);
}

/// The input of a run's method: the steps of all legs, one after another.
std::vector<RawlogStep> shownSteps(const std::vector<WakeupLeg>& legs)
{
  std::vector<RawlogStep> shown;
  for (const WakeupLeg& leg : legs)
  {
    for (std::size_t i = leg.first; i < leg.last; ++i)
    {
      shown.push_back(leg.drive->steps[i].step);
      if (i > leg.first) continue;
      // A robot that wakes up, or was carried, has not driven the distance before.
      if (shown.back().motion) shown.back().motion = MotionIncrement{};
      shown.back().actions = nullptr;
    }
  }
  return shown;
}

void judgeLeg(const WakeupLeg& leg, const std::vector<TimedClaim>& claims,
              const AccuracyGates& gates, Wakeup& run)
{
  const std::vector<WakeupDriveStep>& steps = leg.drive->steps;
  const double before = run.steps.empty() ? 0 : run.steps.back().travelled;
  const double seconds_before = run.steps.empty() ? 0 : run.steps.back().seconds;
  for (std::size_t i = leg.first; i < leg.last; ++i)
  {
    const TimedClaim& timed = claims.at(run.steps.size());
    WakeupStep record;
    record.claim = timed.claim;
    record.time_ms = timed.time_ms;
    record.step = i;
    record.kidnapped = run.kidnapped_at > 0;
    record.travelled = before + steps[i].travelled - steps[leg.first].travelled;
    record.seconds = seconds_before + steps[i].step.time - steps[leg.first].step.time;
    record.saw_nothing =
        countValidBeams(steps[i].step.scans) < kBeamsToSee && steps[i].step.landmarks.empty();
    judge(steps[i], leg.drive->foreign, gates, record);
    run.steps.push_back(record);
  }
}
}  // namespace

bool isMapped(const mrpt::math::TPose2D& truth,
              const std::vector<mrpt::math::TPose2D>& mapped_poses)
{
  constexpr double kMappedDistance = 1.0;  // [m]
  return mapped_poses.empty() ||
         std::any_of(mapped_poses.begin(), mapped_poses.end(),
                     [&](const mrpt::math::TPose2D& pose)
                     { return std::hypot(pose.x - truth.x, pose.y - truth.y) <= kMappedDistance; });
}

void markStepsWithoutTruth(std::vector<WakeupDriveStep>& steps)
{
  const auto carry = [](auto begin, auto end)
  {
    bool mapped = true;  // of the last step with truth
    for (auto step = begin; step != end; ++step)
    {
      if (step->truth) mapped = step->mapped;
      step->mapped = step->mapped && mapped;
    }
  };
  carry(steps.begin(), steps.end());
  carry(steps.rbegin(), steps.rend());
}

Wakeup runLegs(const TrackingMethodFactory& factory, const std::vector<WakeupLeg>& legs,
               std::uint32_t seed, const AccuracyGates& gates)
{
  const auto drive_all = [&]
  {
    Wakeup run;
    run.start = legs.front().first;
    // Building the filter is part of the cost of waking up.
    const double before = threadCpuSeconds();
    const auto method = factory.start(seed);
    const double set_up_ms = 1e3 * (threadCpuSeconds() - before);
    const std::vector<TimedClaim> claims = method->drive(shownSteps(legs));
    for (const WakeupLeg& leg : legs)
    {
      if (&leg != &legs.front()) run.kidnapped_at = run.steps.size();
      judgeLeg(leg, claims, gates, run);
    }
    run.steps.front().time_ms += set_up_ms;
    return run;
  };
  Wakeup run = factory.needsOwnProcess() ? runInOwnProcess(drive_all) : drive_all();
  judgeRun(run);
  return run;
}
}  // namespace sigloc::detail
