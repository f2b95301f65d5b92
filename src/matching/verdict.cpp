// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/verdict.h"

#include <optional>

#include "geometry/pose_fusion.h"

namespace sigloc
{
namespace
{
constexpr double kNotHere = 0.95;  // least probability of being elsewhere
constexpr double kMaxOpenSigma = 0.5;  // [m] position sigma from which a pose is a line of poses

/// Returns why the first pose cannot be claimed, or nothing.
std::optional<VerdictReason> objectionTo(const VerdictGrounds& grounds, double sure)
{
  if (largestPositionSigma(grounds.first_pose) >= kMaxOpenSigma)
  {
    return VerdictReason::open_position;
  }
  if (grounds.doubtful) return VerdictReason::doubtful;
  if (!grounds.confirmed) return VerdictReason::unconfirmed;
  if (!(grounds.first >= sure)) return VerdictReason::not_sure;
  return std::nullopt;
}
}  // namespace

VerdictDecision decideVerdict(const VerdictGrounds& grounds, double sure)
{
  if (grounds.poses == 0)
  {
    if (grounds.sees_too_little)
    {
      return {Verdict::too_little_seen, grounds.elsewhere, VerdictReason::no_pose_seen_little};
    }
    if (grounds.unfinished)
    {
      return {Verdict::too_little_seen, grounds.elsewhere, VerdictReason::no_pose_unfinished};
    }
    return {Verdict::not_here, grounds.elsewhere, VerdictReason::no_pose};
  }
  const std::optional<VerdictReason> objection = objectionTo(grounds, sure);
  if (!objection) return {Verdict::localized, grounds.first, VerdictReason::one_pose};
  if (grounds.elsewhere >= kNotHere && !grounds.unfinished)
  {
    return {Verdict::not_here, grounds.elsewhere, VerdictReason::elsewhere};
  }
  return {Verdict::ambiguous, 1.0 - grounds.first, *objection};
}

const char* toString(VerdictReason reason)
{
  switch (reason)
  {
    case VerdictReason::no_pose:
      return "nothing in the map explains the scan";
    case VerdictReason::no_pose_seen_little:
      return "fewer returns than needed";
    case VerdictReason::no_pose_unfinished:
      return "the search ended at its budget and has found nothing yet";
    case VerdictReason::one_pose:
      return "one hypothesis holds";
    case VerdictReason::elsewhere:
      return "no hypothesis explains the scan";
    case VerdictReason::open_position:
      return "the position is open along a line";
    case VerdictReason::doubtful:
      return "the hypothesis explains much less than it used to";
    case VerdictReason::not_sure:
      return "other hypotheses remain";
    case VerdictReason::unconfirmed:
      return "too little of what has been seen is explained by this map alone";
  }
  return "unknown";
}
}  // namespace sigloc
