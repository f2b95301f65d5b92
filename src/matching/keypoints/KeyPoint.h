// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/symmetric_matrix.h"
#include "sigloc/features/Feature.h"
#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
/// What a key point is. All but the circle have a direction.
enum class KeyPointKind : std::uint8_t
{
  wall_start = 0,  ///< a wall end on the side of the start; direction along the wall
  wall_end = 1,  ///< the same on the side of the end
  crossing = 2,  ///< where two wall lines cross; direction halfway between the two normals
  circle = 3,  ///< the centre of a circle
  count
};
constexpr std::size_t kKeyPointKinds = static_cast<std::size_t>(KeyPointKind::count);

/// A place that a few features fix precisely, with the covariance that follows from theirs. Pairs
/// of key points are what the pair index holds. \cite algorithm eq. (4.11), (4.12)
struct KeyPoint
{
  KeyPointKind kind = KeyPointKind::circle;
  mrpt::math::TPoint2D position;  ///< [m]
  double direction = 0;  ///< [rad]; of a circle 0
  double direction_variance = 0;  ///< [rad^2]
  double radius = 0;  ///< [m], of a circle, else 0
  double radius_variance = 0;  ///< [m^2]
  Symmetric2 covariance;  ///< of the position [m^2]
};

/// Returns the key points of observed features. Walls cross up to 3 m beyond the observed pieces,
/// because something may hide the rest of them.
std::vector<KeyPoint> observedKeyPoints(const std::vector<Feature>& features);

/// Returns the key points of a map. Walls cross up to 1 m beyond the linked walls.
std::vector<KeyPoint> mappedKeyPoints(const FeatureMap& map);
}  // namespace sigloc
