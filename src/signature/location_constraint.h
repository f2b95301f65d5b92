// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/PoseEstimate.h"
#include "signature/DirectedFeature.h"

namespace sigloc
{
/// Returns the location-dependent constraint r_j(x): the difference between a mapped feature and
/// the position that the pose predicts for an observed one. Point-like features give two
/// coordinates. Segments give the angle and the offset at the middle of the observed piece.
/// `relative_sigma` [m] is the map's own error over the distance in question. \cite algorithm eq.
/// (3.9), (3.10)
PlanarMeasurement placeMeasurement(const PoseEstimate& pose, const DirectedFeature& observed,
                                   const DirectedFeature& mapped, double relative_sigma);

/// Returns the part of a place measurement's noise that is the map's own. It is the same in every
/// scan, while the rest is independent. This is M of \cite algorithm eq. (8.13).
Symmetric2 mapNoise(const PoseEstimate& pose, const DirectedFeature& observed,
                    const DirectedFeature& mapped, double relative_sigma);

/// Returns the constraint on the direction of a corner or wall end, a single scalar.
/// \cite algorithm eq. (3.11)
PlanarMeasurement directionMeasurement(const PoseEstimate& pose, const DirectedFeature& observed,
                                       const DirectedFeature& mapped);

/// Returns a weak constraint along a wall: the observed piece lies somewhere on the mapped stretch.
/// With it, a hypothesis of parallel walls stays a line of poses with a finite, large variance.
PlanarMeasurement slideMeasurement(const PoseEstimate& pose, const DirectedFeature& observed,
                                   const DirectedFeature& mapped);

/// A stretch of a mapped line [m], along the mapped tangent from the mapped position.
struct Stretch
{
  double low = 0;
  double high = 0;
};
/// Returns the stretch that an observed segment covers when placed by the pose.
Stretch placedStretch(const PoseEstimate& pose, const DirectedFeature& observed,
                      const DirectedFeature& mapped);
}  // namespace sigloc
