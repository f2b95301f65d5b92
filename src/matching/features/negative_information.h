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
/// Negative information without beams: returns how many mapped places lie well inside the convex
/// hull of the paired places, as seen from the pose, and are of a type that was seen, but are not
/// paired themselves. What lies between things that were seen should have been seen.
/// \cite algorithm eq. (5.11)
std::size_t countMissed(const PreparedScene& scene, const PreparedMap& map,
                        const PoseEstimate& pose, const std::vector<FeaturePairing>& pairings);

/// The same for everything that was seen, paired or not: the area is then the same for all poses
/// that are compared. Only points and circles count, walls hide the others.
/// \cite algorithm eq. (8.14)
std::size_t countMissedInView(const PreparedScene& scene, const PreparedMap& map,
                              const PoseEstimate& pose,
                              const std::vector<FeaturePairing>& pairings);
}  // namespace sigloc
