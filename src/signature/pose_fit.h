// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/PoseEstimate.h"
#include "signature/DirectedFeature.h"

#include <optional>
#include <vector>

namespace sigloc
{
/// An observed feature taken to be a mapped one.
struct DirectedPairing
{
  DirectedFeature observed;
  DirectedFeature mapped;
};

/// Returns the pose that two pairings fix, with covariance: two places, two walls, or a place and
/// a wall in closed form, then one step of least squares over all they measure. Parallel walls
/// leave a direction open and give it a large variance. nullopt when not even that is possible:
/// two coincident places. \cite algorithm eq. (5.1) to (5.4)
std::optional<PoseEstimate> poseFromBase(const DirectedPairing& first,
                                         const DirectedPairing& second, double relative_sigma);

/// Returns the pose that takes `count` >= 2 observed places onto mapped ones, in closed form, all
/// with the same variance [m^2] of each coordinate. nullopt when the places coincide.
/// \cite algorithm eq. (5.1)
std::optional<PoseEstimate> poseFromPlaces(const mrpt::math::TPoint2D* observed,
                                           const mrpt::math::TPoint2D* mapped, std::size_t count,
                                           double variance);

/// Returns the pose that one corner or other directed place fixes by itself, else nullopt.
std::optional<PoseEstimate> poseFromCorner(const DirectedPairing& pairing, double relative_sigma);

/// Returns the least-squares pose over the pairings, by Gauss-Newton from `start`, with its
/// covariance; a direction that no pairing fixes is held by the extent of the walls. nullopt when
/// the pairings do not fix a pose. \cite algorithm eq. (5.8)
std::optional<PoseEstimate> refinePose(const PoseEstimate& start,
                                       const std::vector<DirectedPairing>& pairings,
                                       double relative_sigma, int iterations = 3);
}  // namespace sigloc
