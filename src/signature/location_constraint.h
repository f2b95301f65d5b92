// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/PoseEstimate.h"
#include "signature/DirectedFeature.h"

namespace sigloc
{
/// The location-dependent constraint r_j(x): how far a mapped feature is from where the pose
/// predicts an observed one. Point-like features give their two coordinates, segments the angle
/// and the offset at the middle of the observed piece. `relative_sigma` [m] is the map's own error
/// over the distance in question. \cite algorithm eq. (3.9), (3.10)
PlanarMeasurement placeMeasurement(const PoseEstimate& pose, const DirectedFeature& observed,
                                   const DirectedFeature& mapped, double relative_sigma);

/// The part of a place measurement's noise that is the map's own: it stays the same from look to
/// look, where the rest is drawn anew. \cite algorithm eq. (8.13)
Symmetric2 mapNoise(const PoseEstimate& pose, const DirectedFeature& observed,
                    const DirectedFeature& mapped, double relative_sigma);

/// The direction of a corner or wall end, as a single scalar. \cite algorithm eq. (3.11)
PlanarMeasurement directionMeasurement(const PoseEstimate& pose, const DirectedFeature& observed,
                                       const DirectedFeature& mapped);

/// A weak statement along a wall: the observed piece lies somewhere on the mapped stretch. It keeps
/// a hypothesis of parallel walls a line of poses with a finite, large variance along it.
PlanarMeasurement slideMeasurement(const PoseEstimate& pose, const DirectedFeature& observed,
                                   const DirectedFeature& mapped);

/// Returns the stretch of the mapped line, in metres along the mapped tangent from the mapped
/// position, that an observed segment covers when placed by the pose.
struct Stretch
{
  double low = 0;
  double high = 0;
};
Stretch placedStretch(const PoseEstimate& pose, const DirectedFeature& observed,
                      const DirectedFeature& mapped);
}  // namespace sigloc
