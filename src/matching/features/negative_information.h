// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/PoseEstimate.h"
#include "matching/features/FeatureHypothesis.h"
#include "matching/features/PreparedScene.h"

namespace sigloc
{
/// Negative information: returns the number of mapped places that should have been seen but are not
/// paired. They lie more than 0.2 m inside the convex hull of the paired places and are of a type
/// that is paired. This is M of \cite algorithm eq. (5.11).
std::size_t countMissed(const PreparedScene& scene, const PreparedMap& map,
                        const PoseEstimate& pose, const std::vector<FeaturePairing>& pairings,
                        MatchingCounters& counters);

/// The same inside the hull of everything seen, paired or not, so that the area is the same for all
/// poses that are compared. Only points and circles count, because walls hide the others.
/// \cite algorithm eq. (8.14)
std::size_t countMissedInView(const PreparedScene& scene, const PreparedMap& map,
                              const PoseEstimate& pose,
                              const std::vector<FeaturePairing>& pairings);
}  // namespace sigloc
