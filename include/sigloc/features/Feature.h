// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <vector>

namespace sigloc
{
/// What a feature is. The numeric values are stored in `.sigmap` files.
enum class FeatureType : std::uint8_t
{
  point = 0,  ///< landmark or reflector: a place, nothing else
  segment = 1,  ///< directed piece of wall; the normal points into the free space
  circle = 2,  ///< pillar or trunk
  corner = 3,  ///< two walls that meet: vertex, bisector, opening
  wall_end = 4,  ///< a wall that stops at a jump edge: end point, direction of the wall, side
};

/// Which end of its directed segment a wall end is: a mirror image swaps the two.
enum class WallSide : std::uint8_t
{
  start = 0,
  end = 1,
};

/// One geometric feature, observed (robot frame) or mapped (map frame).
///
/// All types share one layout, an oriented place with covariance, so that constraints between any
/// two of them read the same way.
///
/// What position [m], direction [rad] and size mean for each type:
///
/// * point: the point; direction and size are unused (0)
/// * segment: its mid-point; the normal, into the free space; the length [m]
/// * circle: the centre; from there towards the middle of the seen arc; the radius [m]
/// * corner: the vertex; the bisector, into the free space; the opening of the free space [rad],
///   in (0, 2 pi)
/// * wall end: the end; from the end along the wall; the length of the wall [m]
///
/// A segment runs along its tangent = normal - pi/2 from `start` to `end`: the free space lies on
/// its left, and a scanner in that free space with counter-clockwise beams sees `start` first.
struct Feature
{
  FeatureType type = FeatureType::point;
  WallSide side = WallSide::start;  ///< wall end only
  bool start_seen = false;  ///< segment: the start is a real end, not an occlusion
  bool end_seen = false;  ///< segment: the end is a real end, not an occlusion
  mrpt::math::TPoint2D position;
  double direction = 0;
  double size = 0;
  /// Covariance of the position [m^2]. For a segment only the part along the normal is
  /// meaningful (the mid-point of the *line*); along the tangent it is the end points' variance.
  mrpt::math::CMatrixDouble22 position_covariance;
  double direction_variance =
      0;  ///< [rad^2]; for a segment uncorrelated with the offset at the mid-point
  double size_variance = 0;  ///< [m^2] or, for a corner, [rad^2]
  std::int32_t label = -1;  ///< class, colour or intensity bin where given, else -1
  std::uint32_t sightings = 1;  ///< in how many scans a map feature was seen
  std::int32_t parent = -1;  ///< corner, wall end: index of a segment it was made of, else -1
};

/// Unit vector along `direction`.
mrpt::math::TPoint2D directionVector(const Feature& feature);

/// Unit vector from start to end of a segment (direction - pi/2).
mrpt::math::TPoint2D tangentVector(const Feature& segment);

/// End points of a segment [m], in the frame of the feature.
mrpt::math::TPoint2D segmentStart(const Feature& segment);
mrpt::math::TPoint2D segmentEnd(const Feature& segment);

/// Signed distance of the origin's line equation: n . p = d with n = (cos direction, sin
/// direction).
double lineDistance(const Feature& segment);

/// Returns the feature seen from another frame: `b_from_a` applied to a feature given in frame a.
/// Covariances are rotated; the pose is taken as exact.
Feature transformed(const mrpt::math::TPose2D& b_from_a, const Feature& feature_in_a);
}  // namespace sigloc
