// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "sigloc/matching/RelocationResult.h"

namespace sigloc
{
/// What a verdict is decided from: the poses of one scan, of tracked hypotheses or of particles.
struct VerdictGrounds
{
  std::size_t poses = 0;  ///< number of poses that are left
  double first = 0;  ///< probability of the first of them
  GaussianPose first_pose;
  double elsewhere = 1;  ///< probability that the robot is at none of them
  bool confirmed = false;  ///< the evidence that the robot is in the map is strong enough
  bool doubtful = false;  ///< the first pose has stopped explaining the scans
  bool sees_too_little = false;  ///< the scan has too few returns for the verdict *not here*
  bool unfinished = false;  ///< the map was not searched to its end, so it is not ruled out
};

/// What decided the verdict.
enum class VerdictReason
{
  no_pose,  ///< nothing in the map explains the scan
  no_pose_seen_little,  ///< no pose is left, but the scan shows too little to rule the map out
  no_pose_unfinished,  ///< no pose was found, but the map was not searched to its end
  one_pose,  ///< one pose is claimed
  elsewhere,  ///< the probability of being elsewhere is at least 0.95
  open_position,  ///< the pose is a line of poses
  doubtful,  ///< the first pose has stopped explaining the scans
  not_sure,  ///< the probability of the first pose is too low, because it has rivals
  unconfirmed,  ///< the evidence that the robot is in the map is too weak
};

/// Returns one line for people.
const char* toString(VerdictReason reason);

/// A verdict with its probability and reason.
struct VerdictDecision
{
  Verdict verdict = Verdict::too_little_seen;
  double probability = 0;  ///< of the verdict's claim
  VerdictReason reason = VerdictReason::no_pose_seen_little;
};

/// Returns the verdict for the matcher, the tracker and the particle filter alike. A claim requires
/// the probability `sure` and a largest position sigma below 0.5 m. *Not here* requires a finished
/// search, and no pose or a probability of 0.95 of being elsewhere.
/// \cite algorithm section 7, "The verdict"; section 8, "Publish"
VerdictDecision decideVerdict(const VerdictGrounds& grounds, double sure = kLocalizedProbability);
}  // namespace sigloc
