// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "sigloc/features/Feature.h"

namespace sigloc::test
{
/// A wall from one point to another [m], with the free space on its left.
inline Feature wallBetween(const mrpt::math::TPoint2D& start, const mrpt::math::TPoint2D& end)
{
  const mrpt::math::TPoint2D along = end - start;
  Feature wall;
  wall.type = FeatureType::segment;
  wall.position = (start + end) * 0.5;
  wall.direction = std::atan2(along.y, along.x) + M_PI / 2;
  wall.size = along.norm();
  wall.position_covariance(0, 0) = wall.position_covariance(1, 1) = 1e-4;
  wall.direction_variance = wall.size_variance = 1e-4;
  return wall;
}
}  // namespace sigloc::test
