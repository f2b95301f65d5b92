// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>

#include "CellView.h"
#include "likelihood_table.h"
#include "sigloc/matching/DenseVerifier.h"

namespace sigloc
{
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kMaxShift = 0.5;  // [m] a refinement may move a pose
constexpr double kMaxTurn = 10.0 * M_PI / 180.0;  // [rad]
constexpr float kFirstRobustSigma = 0.25F;  // [m], scale of the Cauchy weight of the first step
constexpr float kRobustSigma = 0.12F;  // [m], and of the later ones
constexpr double kHold = 0.05;  // keeps what the returns leave open
constexpr double kConverged = 1e-3;  // [m], [rad], a step this small is the last

/// Symmetric 3x3 system H delta = -g of one refinement step, in the order (x, y, phi).
struct NormalEquations
{
  double xx = kHold, xy = 0, xt = 0, yy = kHold, yt = 0, tt = kHold;
  double gx = 0, gy = 0, gt = 0;

  /// By Cholesky; kHold keeps the system positive definite.
  std::array<double, 3> solve() const
  {
    const double l00 = std::sqrt(xx);
    const double l10 = xy / l00;
    const double l20 = xt / l00;
    const double l11 = std::sqrt(yy - l10 * l10);
    const double l21 = (yt - l20 * l10) / l11;
    const double l22 = std::sqrt(tt - l20 * l20 - l21 * l21);
    const double a = -gx / l00;
    const double b = (-gy - l10 * a) / l11;
    const double c = (-gt - l20 * a - l21 * b) / l22;
    const double t = c / l22;
    const double y = (b - l21 * t) / l11;
    const double x = (a - l10 * y - l20 * t) / l00;
    return {x, y, t};
  }
};

/// Returns on a wall pull along the wall's normal only, others towards the nearest wall cell.
NormalEquations normalEquations(const DenseField& field, const DenseScan& scan, std::size_t count,
                                const TPose2D& pose, float robust_sigma)
{
  const Placement place(pose);
  const CellView cells(field);
  const float inverse_square = 1.0F / (robust_sigma * robust_sigma);
  float xx = 0, xy = 0, xt = 0, yy = 0, yt = 0, tt = 0, gx = 0, gy = 0, gt = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const float rx = place.c * scan.x[i] - place.s * scan.y[i];
    const float ry = place.s * scan.x[i] + place.c * scan.y[i];
    float ex = 0;
    float ey = 0;
    if (!cells.offsetToWall(place.x + rx, place.y + ry, ex, ey)) continue;
    const float weight = 1.0F / (1.0F + (ex * ex + ey * ey) * inverse_square);
    if (scan.nx[i] != 0 || scan.ny[i] != 0)
    {
      const float nx = place.c * scan.nx[i] - place.s * scan.ny[i];
      const float ny = place.s * scan.nx[i] + place.c * scan.ny[i];
      const float nt = ny * rx - nx * ry;
      const float error = weight * (nx * ex + ny * ey);
      xx += weight * nx * nx;
      xy += weight * nx * ny;
      xt += weight * nx * nt;
      yy += weight * ny * ny;
      yt += weight * ny * nt;
      tt += weight * nt * nt;
      gx += error * nx;
      gy += error * ny;
      gt += error * nt;
    }
    else
    {
      const float half = 0.5F * weight;
      xx += half;
      yy += half;
      xt -= half * ry;
      yt += half * rx;
      tt += half * (rx * rx + ry * ry);
      gx += half * ex;
      gy += half * ey;
      gt += half * (rx * ey - ry * ex);
    }
  }
  NormalEquations equations;
  equations.xx += static_cast<double>(xx);
  equations.xy += static_cast<double>(xy);
  equations.xt += static_cast<double>(xt);
  equations.yy += static_cast<double>(yy);
  equations.yt += static_cast<double>(yt);
  equations.tt += static_cast<double>(tt);
  equations.gx = static_cast<double>(gx);
  equations.gy = static_cast<double>(gy);
  equations.gt = static_cast<double>(gt);
  return equations;
}
}  // namespace

TPose2D DenseVerifier::refine(const DenseScan& scan, const TPose2D& start, int steps,
                              std::size_t beams) const
{
  const std::size_t count = std::min(beams, scan.size());
  TPose2D pose = start;
  for (int step = 0; step < steps; ++step)
  {
    const float robust_sigma = step == 0 ? kFirstRobustSigma : kRobustSigma;
    const NormalEquations equations = normalEquations(field_, scan, count, pose, robust_sigma);
    const std::array<double, 3> delta = equations.solve();
    pose.x += delta[0];
    pose.y += delta[1];
    pose.phi += delta[2];
    if (std::abs(delta[0]) + std::abs(delta[1]) < kConverged && std::abs(delta[2]) < kConverged)
    {
      break;
    }
  }
  pose.phi = wrapToPi(pose.phi);
  const bool inside = std::hypot(pose.x - start.x, pose.y - start.y) <= kMaxShift &&
                      std::abs(wrapToPi(pose.phi - start.phi)) <= kMaxTurn;
  return inside ? pose : start;
}

mrpt::math::CMatrixDouble33 DenseVerifier::covarianceAt(const DenseScan& scan, const TPose2D& pose,
                                                        double common_sigma) const
{
  constexpr double kRangeSigma = 0.05;  // [m], of a return against the raster
  constexpr double kOpenSigma = 5.0;  // [m], of a direction that nothing fixes
  constexpr double kIndependentBeams = 40;  // neighbouring beams are correlated
  const Placement place(pose);
  const CellView cells(field_);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < scan.size(); ++i)
  {
    const float rx = place.c * scan.x[i] - place.s * scan.y[i];
    const float ry = place.s * scan.x[i] + place.c * scan.y[i];
    const DenseCell& cell = cells.at(place.x + rx, place.y + ry);
    const double weight = static_cast<double>(fineTable()[cell.distance]);
    if (weight <= 0.05) continue;
    const double nx = static_cast<double>(place.c * scan.nx[i] - place.s * scan.ny[i]);
    const double ny = static_cast<double>(place.s * scan.nx[i] + place.c * scan.ny[i]);
    const auto add = [&](double ax, double ay, double w)
    {
      const Eigen::Vector3d j(ax, ay, ay * static_cast<double>(rx) - ax * static_cast<double>(ry));
      information += w * j * j.transpose();
    };
    if (nx != 0 || ny != 0)
    {
      add(nx, ny, weight);
    }
    else
    {
      add(1, 0, 0.5 * weight);
      add(0, 1, 0.5 * weight);
    }
  }
  const double tempering = std::min(1.0, kIndependentBeams / static_cast<double>(scan.size() + 1));
  information *= tempering / (kRangeSigma * kRangeSigma);
  information(0, 0) += 1.0 / (kOpenSigma * kOpenSigma);
  information(1, 1) += 1.0 / (kOpenSigma * kOpenSigma);
  information(2, 2) += 1.0 / (0.2 * 0.2);
  Eigen::Matrix3d covariance = information.inverse();
  covariance(0, 0) += common_sigma * common_sigma;
  covariance(1, 1) += common_sigma * common_sigma;
  mrpt::math::CMatrixDouble33 out;
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c) out(r, c) = 0.5 * (covariance(r, c) + covariance(c, r));
  }
  return out;
}
}  // namespace sigloc
