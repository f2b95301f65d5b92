// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/verdict.h"
#include "sigloc/map/DenseField.h"
#include "sigloc/map/FeatureMap.h"
#include "sigloc/tracking/Belief.h"
#include "sigloc/tracking/TrackerOptions.h"
#include "tracking/tracks/TrackSet.h"

namespace sigloc
{
/// Returns what is published of the tracks, which must be sorted: their poses with the map's common
/// error, and their weights. In a dense field they share the probability of being in the map by
/// their weights. The floor of "somewhere else" starts new tracks, and says nothing about where the
/// robot is. Without a verdict. Eq. (8.25)
Belief beliefOf(const TrackSet& set, const FeatureMap& map, const TrackerOptions& options);

/// The dense field of a map, or null.
const DenseField* fieldOf(const FeatureMap& map);

/// Sets the verdict of a belief, its probability and its reason by decideVerdict(). The poses and
/// probabilities of `grounds` are taken from its hypotheses (heaviest first) and the probability of
/// being elsewhere. A claim requires the
/// probability `sure`. Without a field (null) the reason does not say where rivals differ.
/// \cite algorithm section 8, "Publish"
void setVerdict(Belief& belief, VerdictGrounds grounds, double sure, const DenseField* field);
}  // namespace sigloc
