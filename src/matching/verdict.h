// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "sigloc/matching/RelocationResult.h"

namespace sigloc
{
/// What is known when a verdict falls: of one scan, of tracked hypotheses or of particles.
struct VerdictGrounds
{
  std::size_t poses = 0;  ///< hypotheses that are left
  double first = 0;  ///< probability of the first of them
  GaussianPose first_pose;
  double elsewhere = 1;  ///< probability of standing where none of them is
  bool confirmed = true;  ///< enough is known that only this map explains
  bool doubtful = false;  ///< the first has stopped explaining what is seen
  bool sees_too_little = false;  ///< to say that the robot is not here
};

/// What decided.
enum class VerdictReason
{
  no_pose,  ///< nothing in the map explains the scan
  no_pose_seen_little,  ///< no pose is left, but the scan shows too little to rule the map out
  one_pose,
  elsewhere,
  open_position,  ///< the pose is a line of poses
  doubtful,
  not_sure,  ///< the first lacks probability: it has rivals
  unconfirmed,
};

/// One line for people.
const char* toString(VerdictReason reason);

struct VerdictDecision
{
  Verdict verdict = Verdict::too_little_seen;
  double probability = 0;  ///< of the verdict's claim
  VerdictReason reason = VerdictReason::no_pose_seen_little;
};

/// Returns the verdict that the grounds allow: the one place where it falls, for the matcher, the
/// tracker and the particle filter. A claim takes the probability `sure` and a position known to
/// 0.5 m; *not here* takes 0.98 elsewhere. \cite algorithm sections 7 and 8, "Verdict"
VerdictDecision decideVerdict(const VerdictGrounds& grounds, double sure = kLocalizedProbability);
}  // namespace sigloc
