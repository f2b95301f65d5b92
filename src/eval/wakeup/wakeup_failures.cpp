// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "eval/wakeup/wakeup_drive.h"

namespace sigloc::detail
{
namespace
{
std::size_t tellingStep(const Wakeup& run)
{
  const auto wrong =
      std::find_if(run.steps.begin(), run.steps.end(),
                   [](const WakeupStep& step) { return step.judged == Claim::wrong; });
  if (wrong != run.steps.end()) return static_cast<std::size_t>(wrong - run.steps.begin());
  return judgedStep(run).value_or(run.steps.size() - 1);
}

RelocationRecord recordOf(const WakeupStep& step)
{
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  RelocationRecord record;
  record.verdict = step.claim.belief      ? step.claim.verdict
                   : step.claim.confident ? Verdict::localized
                                          : Verdict::ambiguous;
  record.probability = step.claim.belief ? step.claim.weights[0] : kNone;
  record.error = step.error;
  record.claim = step.judged;
  return record;
}
}  // namespace

FailedQuery failureOf(const Wakeup& run, const std::vector<WakeupLeg>& legs,
                      const std::string& method, std::shared_ptr<const FeatureMap> map)
{
  const std::size_t index = tellingStep(run);
  const WakeupStep& step = run.steps[index];
  const bool kidnapped = run.kidnapped_at > 0 && index >= run.kidnapped_at;
  const WakeupDrive& drive = *legs[kidnapped ? 1 : 0].drive;
  const WakeupDriveStep& seen = drive.steps[step.step];
  FailedQuery failure;
  failure.method = method;
  failure.map = std::move(map);
  failure.query.name =
      fmt::format("{}-step-{}{}", run.start, step.step, kidnapped ? "-kidnapped" : "");
  failure.query.scans = seen.step.scans;
  failure.landmarks = seen.step.landmarks;
  failure.record = recordOf(step);
  if (!drive.foreign) failure.query.truth = failure.record.truth = seen.truth;
  failure.fate = fmt::format("{:.1f} m after waking up{}", step.travelled,
                             kidnapped ? ", kidnapped on the way" : "");
  if (drive.foreign) failure.fate += ", in a foreign map";
  if (step.claim.has_pose)
  {
    Candidate claimed;
    claimed.pose = poseOf(step.claim);
    claimed.probability = step.claim.weights[0];
    claimed.score = std::numeric_limits<double>::quiet_NaN();
    failure.answer.candidates = {claimed};
  }
  return failure;
}
}  // namespace sigloc::detail
