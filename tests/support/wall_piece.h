// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "sigloc/features/Feature.h"

namespace sigloc::test
{
/// A wall piece along x from `from` to `to` at height y; its free side is up or down.
inline Feature wallPiece(double from, double to, double y, bool faces_up)
{
  Feature wall;
  wall.type = FeatureType::segment;
  wall.position = {0.5 * (from + to), y};
  wall.direction = faces_up ? M_PI / 2 : -M_PI / 2;
  wall.size = to - from;
  wall.position_covariance(0, 0) = wall.position_covariance(1, 1) = 1e-4;
  wall.direction_variance = 1e-4;
  return wall;
}
}  // namespace sigloc::test
