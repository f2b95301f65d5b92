// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "signature/location_constraint.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
Symmetric2 pointMapNoise(const DirectedFeature& mapped, double relative_sigma)
{
  const auto& q = mapped.feature->position_covariance;
  const double own = relative_sigma * relative_sigma + kRoundingVariance;
  return {q(0, 0) + own, q(0, 1), q(1, 1) + own};
}

PlanarMeasurement pointMeasurement(const PoseEstimate& pose, const DirectedFeature& observed,
                                   const DirectedFeature& mapped, double relative_sigma)
{
  const TPoint2D arm = pose.turn(observed.position());
  const auto& p = observed.feature->position_covariance;
  const Symmetric2 seen = rotated({p(0, 0), p(0, 1), p(1, 1)}, pose.c, pose.s);
  const Symmetric2 own = pointMapNoise(mapped, relative_sigma);
  PlanarMeasurement m;
  m.residual = {mapped.position().x - pose.x - arm.x, mapped.position().y - pose.y - arm.y};
  m.jacobian = {{{1, 0, -arm.y}, {0, 1, arm.x}}};
  m.noise = {seen.xx + own.xx, seen.xy + own.xy, seen.yy + own.yy};
  return m;
}

/// Returns the vector [m] from the predicted middle of the observed piece to that of the mapped
/// line.
TPoint2D lineOffset(const PoseEstimate& pose, const TPoint2D& arm, const DirectedFeature& mapped)
{
  return {mapped.position().x - pose.x - arm.x, mapped.position().y - pose.y - arm.y};
}

Symmetric2 lineMapNoise(const TPoint2D& offset, const DirectedFeature& mapped,
                        double relative_sigma)
{
  // The mapped line's angle error moves the line at the observed piece in proportion to the lever.
  const double lever = -dot(offset, mapped.tangent());
  const double angle = mapped.feature->direction_variance;
  return {angle + kRoundingVariance, lever * angle,
          varianceAlong(*mapped.feature, mapped.normal) + relative_sigma * relative_sigma +
              lever * lever * angle + kRoundingVariance};
}

PlanarMeasurement lineMeasurement(const PoseEstimate& pose, const DirectedFeature& observed,
                                  const DirectedFeature& mapped, double relative_sigma)
{
  const TPoint2D arm = pose.turn(observed.position());
  const TPoint2D from_pose = lineOffset(pose, arm, mapped);
  const Symmetric2 own = lineMapNoise(from_pose, mapped, relative_sigma);
  PlanarMeasurement m;
  m.residual = {
      mrpt::math::wrapToPi(mapped.feature->direction - observed.feature->direction - pose.heading),
      dot(from_pose, mapped.normal)};
  const double turn = mapped.normal.y * arm.x - mapped.normal.x * arm.y;
  m.jacobian = {{{0, 0, 1}, {mapped.normal.x, mapped.normal.y, turn}}};
  m.noise = {observed.feature->direction_variance + own.xx, own.xy,
             varianceAlong(*observed.feature, observed.normal) + own.yy};
  return m;
}
}  // namespace

PlanarMeasurement placeMeasurement(const PoseEstimate& pose, const DirectedFeature& observed,
                                   const DirectedFeature& mapped, double relative_sigma)
{
  return isSegment(observed.type()) ? lineMeasurement(pose, observed, mapped, relative_sigma)
                                    : pointMeasurement(pose, observed, mapped, relative_sigma);
}

Symmetric2 mapNoise(const PoseEstimate& pose, const DirectedFeature& observed,
                    const DirectedFeature& mapped, double relative_sigma)
{
  return isSegment(observed.type())
             ? lineMapNoise(lineOffset(pose, pose.turn(observed.position()), mapped), mapped,
                            relative_sigma)
             : pointMapNoise(mapped, relative_sigma);
}

PlanarMeasurement directionMeasurement(const PoseEstimate& pose, const DirectedFeature& observed,
                                       const DirectedFeature& mapped)
{
  PlanarMeasurement m;
  m.residual[0] =
      mrpt::math::wrapToPi(mapped.feature->direction - observed.feature->direction - pose.heading);
  m.jacobian = {{{0, 0, 1}, {0, 0, 0}}};
  m.noise = {
      observed.feature->direction_variance + mapped.feature->direction_variance + kRoundingVariance,
      0, 1};
  m.degrees = 1;
  return m;
}

PlanarMeasurement slideMeasurement(const PoseEstimate& pose, const DirectedFeature& observed,
                                   const DirectedFeature& mapped)
{
  const TPoint2D arm = pose.turn(observed.position());
  const TPoint2D tangent = mapped.tangent();
  const TPoint2D from_pose{mapped.position().x - pose.x - arm.x,
                           mapped.position().y - pose.y - arm.y};
  const double middle = 0.5 * (mapped.start + mapped.end);
  const double sigma = std::max(1.0, 0.5 * mapped.length());
  PlanarMeasurement m;
  m.residual[0] = dot(from_pose, tangent) + middle;
  m.jacobian = {{{tangent.x, tangent.y, tangent.y * arm.x - tangent.x * arm.y}, {0, 0, 0}}};
  m.noise = {sigma * sigma, 0, 1};
  m.degrees = 1;
  return m;
}

Stretch placedStretch(const PoseEstimate& pose, const DirectedFeature& observed,
                      const DirectedFeature& mapped)
{
  const TPoint2D middle = pose.place(observed.position());
  const TPoint2D tangent = mapped.tangent();
  const double at = dot(middle - mapped.position(), tangent);
  const double along = dot(pose.turn(observed.tangent()), tangent);
  const double a = at + along * observed.start;
  const double b = at + along * observed.end;
  return {std::min(a, b), std::max(a, b)};
}
}  // namespace sigloc
