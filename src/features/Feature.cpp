// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/features/Feature.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

namespace sigloc
{
using mrpt::math::TPoint2D;

TPoint2D directionVector(const Feature& feature)
{
  return {std::cos(feature.direction), std::sin(feature.direction)};
}

TPoint2D tangentVector(const Feature& segment)
{
  return {std::sin(segment.direction), -std::cos(segment.direction)};
}

TPoint2D segmentStart(const Feature& segment)
{
  return segment.position - tangentVector(segment) * (0.5 * segment.size);
}

TPoint2D segmentEnd(const Feature& segment)
{
  return segment.position + tangentVector(segment) * (0.5 * segment.size);
}

double lineDistance(const Feature& segment)
{
  const TPoint2D normal = directionVector(segment);
  return normal.x * segment.position.x + normal.y * segment.position.y;
}

Feature transformed(const mrpt::math::TPose2D& b_from_a, const Feature& feature_in_a)
{
  Feature feature = feature_in_a;
  feature.position = b_from_a.composePoint(feature_in_a.position);
  if (hasDirection(feature.type))
  {
    feature.direction = mrpt::math::wrapToPi(feature_in_a.direction + b_from_a.phi);
  }
  const double c = std::cos(b_from_a.phi);
  const double s = std::sin(b_from_a.phi);
  const auto& p = feature_in_a.position_covariance;
  auto& q = feature.position_covariance;
  q(0, 0) = c * c * p(0, 0) - 2 * c * s * p(0, 1) + s * s * p(1, 1);
  q(1, 1) = s * s * p(0, 0) + 2 * c * s * p(0, 1) + c * c * p(1, 1);
  q(0, 1) = q(1, 0) = c * s * (p(0, 0) - p(1, 1)) + (c * c - s * s) * p(0, 1);
  return feature;
}
}  // namespace sigloc
