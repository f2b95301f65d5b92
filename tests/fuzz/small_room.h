// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "sigloc/features/LaserScan.h"
#include "sigloc/map/FeatureMap.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/HypothesisTracker.h"

namespace sigloc::fuzz
{
constexpr std::size_t kBeams = 91;

/// A room of 8 m x 6 m with an inner wall and two pillars, at cells of 0.1 m.
std::shared_ptr<const FeatureMap> smallRoom();
/// The features of that room without its dense field.
std::shared_ptr<const FeatureMap> landmarksOfRoom();
/// Matchers with usual options.
std::shared_ptr<const SignatureMatcher> matcherIn(const std::shared_ptr<const FeatureMap>& map);

/// The scan from a pose in the room: a full turn of kBeams.
LaserScan scanInRoom(const mrpt::math::TPose2D& map_from_robot);

/// Throws Finding unless a belief or an answer obeys its laws. A belief is only *localized* from
/// the probability `sure` on.
void requireLaws(const Belief& belief, double sure = kLocalizedProbability);
void requireLaws(const RelocationResult& result);
}  // namespace sigloc::fuzz
