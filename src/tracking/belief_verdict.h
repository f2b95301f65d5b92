// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/map/DenseField.h"
#include "sigloc/tracking/Belief.h"

namespace sigloc
{
/// What decides a verdict besides the probabilities.
struct BeliefGrounds
{
  bool confirmed = false;  ///< the evidence that the robot is in the map is strong enough
  bool doubtful = false;  ///< the first hypothesis has stopped explaining the scans
  bool sees_too_little = false;  ///< the scan has too few returns for the verdict *not here*
};

/// Sets the verdict of a belief, its probability and its reason by decideVerdict(), from its
/// hypotheses (heaviest first) and the probability of being elsewhere. A claim requires the
/// probability `sure`. Without a field (null) the reason does not say where rivals differ.
/// \cite algorithm section 8, "Publish"
void setVerdict(Belief& belief, const BeliefGrounds& more, double sure, const DenseField* field);
}  // namespace sigloc
