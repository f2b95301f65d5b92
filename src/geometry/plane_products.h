// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

namespace sigloc
{
inline double dot(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b)
{
  return a.x * b.x + a.y * b.y;
}

/// Returns the third coordinate of the cross product: positive where b is on the left of a.
inline double cross(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b)
{
  return a.x * b.y - a.y * b.x;
}
}  // namespace sigloc
