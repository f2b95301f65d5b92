// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/CMatrixFixed.h>

#include <optional>

namespace sigloc
{
/// Symmetric 2x2 matrix as three numbers, for inner loops.
struct Symmetric2
{
  double xx = 0;
  double xy = 0;
  double yy = 0;
};

/// Symmetric 3x3 matrix over (x, y, heading t) as six numbers, for inner loops.
struct Symmetric3
{
  double xx = 0;
  double xy = 0;
  double xt = 0;
  double yy = 0;
  double yt = 0;
  double tt = 0;
};

inline double determinant(const Symmetric2& m)
{
  return m.xx * m.yy - m.xy * m.xy;
}

inline double determinant(const Symmetric3& m)
{
  return m.xx * (m.yy * m.tt - m.yt * m.yt) - m.xy * (m.xy * m.tt - m.yt * m.xt) +
         m.xt * (m.xy * m.yt - m.yy * m.xt);
}

/// Returns v' M^-1 v for a positive definite M.
inline double squaredNorm(double vx, double vy, const Symmetric2& m)
{
  return (m.yy * vx * vx - 2 * m.xy * vx * vy + m.xx * vy * vy) / determinant(m);
}

/// Returns R(angle) M R(angle)', the angle given by its cosine and sine.
inline Symmetric2 rotated(const Symmetric2& m, double c, double s)
{
  return {c * c * m.xx - 2 * c * s * m.xy + s * s * m.yy,
          c * s * (m.xx - m.yy) + (c * c - s * s) * m.xy,
          s * s * m.xx + 2 * c * s * m.xy + c * c * m.yy};
}

/// Returns the inverse, or nullopt when the matrix is not positive definite to working precision.
std::optional<Symmetric3> inverse(const Symmetric3& m);

Symmetric2 toSymmetric(const mrpt::math::CMatrixDouble22& m);
Symmetric3 toSymmetric(const mrpt::math::CMatrixDouble33& m);
mrpt::math::CMatrixDouble33 toMatrix(const Symmetric3& m);
}  // namespace sigloc
