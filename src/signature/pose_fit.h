// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/PoseEstimate.h"
#include "signature/DirectedFeature.h"

#include <optional>
#include <vector>

namespace sigloc
{
/// An observed feature that is assumed to be a mapped one.
struct DirectedPairing
{
  DirectedFeature observed;
  DirectedFeature mapped;
};

/// Returns the pose that two pairings fix, with covariance. Two places, two walls, or a place and a
/// wall give it in closed form; one step of least squares over all measurements follows. Parallel
/// walls leave a direction open, which gets a large variance. Returns nullopt for two coincident
/// places. \cite algorithm eq. (5.1) to (5.4)
std::optional<PoseEstimate> poseFromBase(const DirectedPairing& first,
                                         const DirectedPairing& second, double relative_sigma);

/// Returns the pose that maps `count` >= 2 observed places onto mapped ones, in closed form. Each
/// coordinate has the same variance [m^2]. Returns nullopt when the places coincide.
/// \cite algorithm eq. (5.1)
std::optional<PoseEstimate> poseFromPlaces(const mrpt::math::TPoint2D* observed,
                                           const mrpt::math::TPoint2D* mapped, std::size_t count,
                                           double variance);

/// Returns the least-squares pose over the pairings with its covariance, by Gauss-Newton from
/// `start`. The extent of the walls limits a direction that no pairing fixes. Returns nullopt when
/// the pairings do not fix a pose. \cite algorithm eq. (5.8)
std::optional<PoseEstimate> refinePose(const PoseEstimate& start,
                                       const std::vector<DirectedPairing>& pairings,
                                       double relative_sigma, int iterations = 3);
}  // namespace sigloc
