// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/map/DenseField.h"
#include "sigloc/tracking/Belief.h"

namespace sigloc
{
/// What a verdict rests on besides the weights.
struct BeliefGrounds
{
  bool confirmed = false;  ///< enough is known that only this map explains
  bool doubtful = false;  ///< the first hypothesis has stopped explaining what is seen
  bool sees_too_little = false;  ///< to say that the robot is not here
};

/// Sets the verdict of a belief, its probability and its reason, by decideVerdict() on its
/// hypotheses (heaviest first) and "somewhere else"; a claim takes the weight `sure`. Without a
/// field (null) the reason does not say where rivals differ.
void setVerdict(Belief& belief, const BeliefGrounds& more, double sure, const DenseField* field);
}  // namespace sigloc
