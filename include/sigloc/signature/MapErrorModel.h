// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/geometry/GaussianPose.h"

namespace sigloc
{
/// The map's own error, beyond the covariance of each feature: relative between two features at
/// distance d, and common to a whole neighbourhood. \cite algorithm section 3
struct MapErrorModel
{
  double relative_constant = 0.02;  ///< [m], a of sigma_rel(d) = a + b d
  double relative_slope = 0.002;  ///< [-], b
  double common_sigma = 0.10;  ///< [m], moves a neighbourhood together
  double common_turn_sigma = 0.01;  ///< [rad], turns a neighbourhood: 0.1 m over its 10 m

  /// sigma_rel(d) [m], \cite algorithm eq. (3.2)
  double relativeSigma(double distance) const
  {
    return relative_constant + relative_slope * distance;
  }
};

/// Returns the pose of someone who knows the map only as well as `error` says: what is common to a
/// neighbourhood widens the covariance. \cite algorithm eq. (6.10)
GaussianPose withCommonError(const GaussianPose& pose, const MapErrorModel& error);

/// Takes back what withCommonError() added.
GaussianPose withoutCommonError(const GaussianPose& pose, const MapErrorModel& error);
}  // namespace sigloc
