// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <vector>

namespace sigloc
{
/// A line fitted to returns: n . p = n . centroid with n = (cos normal, sin normal).
/// At the weighted centroid the errors of offset and angle are uncorrelated.
struct LineFit
{
  mrpt::math::TPoint2D centroid;  ///< [m], weighted
  double normal = 0;  ///< [rad], towards the viewpoint
  double offset_variance = 0;  ///< [m^2], of n . centroid
  double angle_variance = 0;  ///< [rad^2]
  double rms = 0;  ///< [m], root mean square distance of the points from the line
};

/// Returns the weighted total least squares line through points[first..last] as seen from
/// `viewpoint`. A range error of sd `range_sigma` [m] moves a point off the line by its component
/// along the normal, so grazing beams have more weight. `surface_sigma` [m] is the roughness of the
/// surface, a lower bound of the error. Throws std::invalid_argument for fewer than two points.
/// \cite algorithm eq. (2.3), (2.4)
LineFit fitLine(const std::vector<mrpt::math::TPoint2D>& points, std::size_t first,
                std::size_t last, const mrpt::math::TPoint2D& viewpoint, double range_sigma,
                double surface_sigma);

/// A circle fitted to returns of its near side.
struct CircleFit
{
  mrpt::math::TPoint2D centre;  ///< [m]
  double radius = 0;  ///< [m]
  double radial_variance = 0;  ///< [m^2], of the centre along the line of sight
  double lateral_variance = 0;  ///< [m^2], of the centre across it
  double radius_variance = 0;  ///< [m^2]
  double rms = 0;  ///< [m], root mean square distance of the points from the circle
};

/// Returns the circle through points[first..last] as seen from `viewpoint`. A short arc alone
/// hardly fixes the radius, so the radius has a prior: half the chord plus the unseen rim, with sd
/// `radius_prior_sigma` [m]. Throws std::invalid_argument for fewer than three points.
/// \cite algorithm eq. (2.2)
CircleFit fitCircle(const std::vector<mrpt::math::TPoint2D>& points, std::size_t first,
                    std::size_t last, const mrpt::math::TPoint2D& viewpoint, double range_sigma,
                    double radius_prior_sigma);
}  // namespace sigloc
