// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/verdict.h"
#include "sigloc/map/DenseField.h"
#include "sigloc/map/FeatureMap.h"
#include "sigloc/tracking/Belief.h"
#include "tracking/tracks/RelocationSchedule.h"
#include "tracking/tracks/TrackSet.h"

namespace sigloc
{
/// Returns what is published of the tracks, which must be sorted: their poses with the map's common
/// error, and their weights. In a dense field they share the probability of being in the map by
/// their weights. The floor of "somewhere else" starts new tracks, and says nothing about where the
/// robot is. Without a verdict. Eq. (8.25)
Belief beliefOf(const TrackSet& set, const FeatureMap& map);

/// Sets the verdict of a belief, its probability and its reason by decideVerdict(). The poses and
/// probabilities of `grounds` are taken from its hypotheses (heaviest first) and the probability of
/// being elsewhere. A claim requires the
/// probability `sure`. Without a field (null) the reason does not say where rivals differ.
/// \cite algorithm section 8, "Publish"
void setVerdict(Belief& belief, VerdictGrounds grounds, double sure, const DenseField* field);

/// What a step tells of a belief, beside the tracks themselves.
struct StepFindings
{
  bool sees_too_little = false;  ///< the scan has too little in it for the verdict *not here*
  bool doubtful = false;  ///< suspicion stops a claim of the first track
  double reliability = 0;  ///< of the first track, in [0, 1]
};

/// Sets the verdict of a belief that beliefOf() has made of the tracks in a map, and its
/// reliability. Tells the schedule of the verdict.
void concludeBelief(Belief& belief, const TrackSet& set, RelocationSchedule& schedule,
                    const FeatureMap& map, const StepFindings& findings);
}  // namespace sigloc
