// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/symmetric_matrix.h"

#include <cmath>

namespace sigloc
{
std::optional<Symmetric3> inverse(const Symmetric3& m)
{
  // Scaled to a unit diagonal first, because metres and radians may differ by orders of magnitude.
  // The determinant of the correlation matrix then measures how independent the three are.
  if (!(m.xx > 0) || !(m.yy > 0) || !(m.tt > 0)) return std::nullopt;
  const double sx = 1 / std::sqrt(m.xx);
  const double sy = 1 / std::sqrt(m.yy);
  const double st = 1 / std::sqrt(m.tt);
  const double xy = m.xy * sx * sy;
  const double xt = m.xt * sx * st;
  const double yt = m.yt * sy * st;
  const double minor_x = 1 - yt * yt;
  const double det = minor_x - xy * (xy - yt * xt) + xt * (xy * yt - xt);
  constexpr double kSingular = 1e-14;
  if (!(minor_x > kSingular) || !(det > kSingular)) return std::nullopt;
  const double scale = 1 / det;
  return Symmetric3{minor_x * scale * sx * sx,        (xt * yt - xy) * scale * sx * sy,
                    (xy * yt - xt) * scale * sx * st, (1 - xt * xt) * scale * sy * sy,
                    (xy * xt - yt) * scale * sy * st, (1 - xy * xy) * scale * st * st};
}

Symmetric2 toSymmetric(const mrpt::math::CMatrixDouble22& m)
{
  return {m(0, 0), 0.5 * (m(0, 1) + m(1, 0)), m(1, 1)};
}

Symmetric3 toSymmetric(const mrpt::math::CMatrixDouble33& m)
{
  return {m(0, 0), 0.5 * (m(0, 1) + m(1, 0)), 0.5 * (m(0, 2) + m(2, 0)),
          m(1, 1), 0.5 * (m(1, 2) + m(2, 1)), m(2, 2)};
}

mrpt::math::CMatrixDouble33 toMatrix(const Symmetric3& m)
{
  mrpt::math::CMatrixDouble33 out;
  out(0, 0) = m.xx;
  out(0, 1) = out(1, 0) = m.xy;
  out(0, 2) = out(2, 0) = m.xt;
  out(1, 1) = m.yy;
  out(1, 2) = out(2, 1) = m.yt;
  out(2, 2) = m.tt;
  return out;
}
}  // namespace sigloc
