// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "sigloc/features/Feature.h"

namespace sigloc
{
/// Calls `visit(point)` every `spacing` [m] along a segment prolonged by `beyond` [m] at both ends,
/// which are included.
template <class Visit>
void walkAlong(const Feature& segment, double spacing, double beyond, Visit&& visit)
{
  const mrpt::math::TPoint2D tangent = tangentVector(segment);
  const mrpt::math::TPoint2D start = segmentStart(segment) - tangent * beyond;
  const double length = segment.size + 2 * beyond;
  const int steps = static_cast<int>(std::ceil(length / spacing));
  for (int k = 0; k <= steps; ++k) visit(start + tangent * std::min(length, k * spacing));
}
}  // namespace sigloc
