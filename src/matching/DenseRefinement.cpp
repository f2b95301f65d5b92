// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>

#include "CellView.h"
#include "likelihood_table.h"
#include "sigloc/matching/DenseVerifier.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kMaxShift = 0.5;  // [m] a refinement may move a pose
constexpr double kMaxTurn = 10.0 * M_PI / 180.0;  // [rad]
}  // namespace

TPose2D DenseVerifier::refine(const DenseScan& scan, const TPose2D& start, int steps,
                              std::size_t beams) const
{
  const std::size_t count = std::min(beams, scan.size());
  const CellView cells(field_);
  TPose2D pose = start;
  for (int step = 0; step < steps; ++step)
  {
    // Returns on a wall pull along the wall's normal only, others towards the nearest wall cell.
    Eigen::Matrix3f hessian = Eigen::Matrix3f::Zero();
    Eigen::Vector3f gradient = Eigen::Vector3f::Zero();
    const Placement place(pose);
    const float robust = step == 0 ? 0.25F : 0.12F;  // [m], scale of the Cauchy weight
    for (std::size_t i = 0; i < count; ++i)
    {
      const float rx = place.c * scan.x[i] - place.s * scan.y[i];
      const float ry = place.s * scan.x[i] + place.c * scan.y[i];
      const float px = place.x + rx;
      const float py = place.y + ry;
      const DenseCell& cell = cells.at(px, py);
      if (cell.distance == 255) continue;
      const TPoint2D wall = cells.nearestWall(px, py, cell);
      const float ex = px - static_cast<float>(wall.x);
      const float ey = py - static_cast<float>(wall.y);
      const float squared = ex * ex + ey * ey;
      const float weight = 1.0F / (1.0F + squared / (robust * robust));
      const float nx = place.c * scan.nx[i] - place.s * scan.ny[i];
      const float ny = place.s * scan.nx[i] + place.c * scan.ny[i];
      const auto add = [&](float ax, float ay, float w)
      {
        const Eigen::Vector3f j(ax, ay, ay * rx - ax * ry);
        hessian.noalias() += w * j * j.transpose();
        gradient.noalias() += w * (ax * ex + ay * ey) * j;
      };
      if (nx != 0 || ny != 0)
      {
        add(nx, ny, weight);
      }
      else
      {
        add(1, 0, 0.5F * weight);
        add(0, 1, 0.5F * weight);
      }
    }
    // What the returns leave open stays where the proposal put it.
    hessian(0, 0) += 0.05F;
    hessian(1, 1) += 0.05F;
    hessian(2, 2) += 0.05F;
    const Eigen::Vector3f delta = hessian.ldlt().solve(-gradient);
    pose.x += static_cast<double>(delta[0]);
    pose.y += static_cast<double>(delta[1]);
    pose.phi += static_cast<double>(delta[2]);
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
