// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/PoseEstimate.h"

#include <mrpt/math/wrap2pi.h>

namespace sigloc
{
PoseEstimate toEstimate(const GaussianPose& pose)
{
  PoseEstimate estimate;
  estimate.x = pose.mean.x;
  estimate.y = pose.mean.y;
  estimate.setHeading(pose.mean.phi);
  estimate.covariance = toSymmetric(pose.covariance);
  return estimate;
}

GaussianPose toGaussian(const PoseEstimate& estimate)
{
  return {{estimate.x, estimate.y, mrpt::math::wrapToPi(estimate.heading)},
          toMatrix(estimate.covariance)};
}

void update(PoseEstimate& estimate, const PlanarMeasurement& m)
{
  const Symmetric3& p = estimate.covariance;
  const Symmetric2 s = innovationCovariance(p, m);
  const double scale = 1 / determinant(s);
  // Rows of P H': the covariance of each pose component with the two measured scalars.
  const std::array<std::array<double, 3>, 3> rows{
      {{p.xx, p.xy, p.xt}, {p.xy, p.yy, p.yt}, {p.xt, p.yt, p.tt}}};
  std::array<std::array<double, 2>, 3> cross{};
  std::array<std::array<double, 2>, 3> gain{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t k = 0; k < 2; ++k)
    {
      cross[i][k] = rows[i][0] * m.jacobian[k][0] + rows[i][1] * m.jacobian[k][1] +
                    rows[i][2] * m.jacobian[k][2];
    }
    gain[i][0] = (cross[i][0] * s.yy - cross[i][1] * s.xy) * scale;
    gain[i][1] = (cross[i][1] * s.xx - cross[i][0] * s.xy) * scale;
  }
  const auto step = [&](std::size_t i)
  { return gain[i][0] * m.residual[0] + gain[i][1] * m.residual[1]; };
  const auto shrink = [&](std::size_t i, std::size_t j)
  { return gain[i][0] * cross[j][0] + gain[i][1] * cross[j][1]; };
  estimate.covariance = {p.xx - shrink(0, 0), p.xy - shrink(0, 1), p.xt - shrink(0, 2),
                         p.yy - shrink(1, 1), p.yt - shrink(1, 2), p.tt - shrink(2, 2)};
  estimate.x += step(0);
  estimate.y += step(1);
  estimate.setHeading(estimate.heading + step(2));
}

void addInformation(const PlanarMeasurement& m, Symmetric3& information,
                    std::array<double, 3>& vector)
{
  const double scale = 1 / determinant(m.noise);
  const auto& a = m.jacobian[0];
  const auto& b = m.jacobian[1];
  std::array<double, 3> wa{};
  std::array<double, 3> wb{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    wa[i] = (m.noise.yy * a[i] - m.noise.xy * b[i]) * scale;
    wb[i] = (m.noise.xx * b[i] - m.noise.xy * a[i]) * scale;
    vector[i] += wa[i] * m.residual[0] + wb[i] * m.residual[1];
  }
  information.xx += wa[0] * a[0] + wb[0] * b[0];
  information.xy += wa[0] * a[1] + wb[0] * b[1];
  information.xt += wa[0] * a[2] + wb[0] * b[2];
  information.yy += wa[1] * a[1] + wb[1] * b[1];
  information.yt += wa[1] * a[2] + wb[1] * b[2];
  information.tt += wa[2] * a[2] + wb[2] * b[2];
}
}  // namespace sigloc
