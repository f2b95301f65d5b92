// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "geometry/plane_products.h"
#include "sigloc/features/Feature.h"

namespace sigloc
{
/// A feature prepared for the constraints of a signature: with the unit vector along its direction
/// and, for a segment, the stretch that its wall covers. Place, type and label are repeated here,
/// so that inner loops read one cache line a feature.
struct DirectedFeature
{
  const Feature* feature = nullptr;
  mrpt::math::TPoint2D place;  ///< the feature's position
  mrpt::math::TPoint2D normal{1, 0};
  double start = 0;  ///< [m] along the tangent from the position, start of the wall
  double end = 0;  ///< [m] the same for its end; fragments of one wall share one stretch
  std::int32_t label = -1;
  FeatureType kind = FeatureType::point;

  FeatureType type() const { return kind; }
  const mrpt::math::TPoint2D& position() const { return place; }
  mrpt::math::TPoint2D tangent() const { return {normal.y, -normal.x}; }
  double length() const { return end - start; }
};
static_assert(sizeof(DirectedFeature) <= 64, "one cache line");

/// Returns a feature prepared by itself: a segment covers its own length.
inline DirectedFeature directed(const Feature& feature)
{
  const double half = isSegment(feature.type) ? 0.5 * feature.size : 0;
  return {&feature,
          feature.position,
          {std::cos(feature.direction), std::sin(feature.direction)},
          -half,
          half,
          feature.label,
          feature.type};
}

// Added to every variance, so that features without any error (simulated ones) do not turn a gate
// into an equality test on floating point numbers.
constexpr double kRoundingVariance = 1e-12;  // [m^2], [rad^2]

/// Returns the variance [m^2] of the feature's position along a unit vector.
inline double varianceAlong(const Feature& feature, const mrpt::math::TPoint2D& unit)
{
  const auto& p = feature.position_covariance;
  return unit.x * unit.x * p(0, 0) + 2 * unit.x * unit.y * p(0, 1) + unit.y * unit.y * p(1, 1);
}
}  // namespace sigloc
