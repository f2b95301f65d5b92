// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "geometry/simd.h"
#include "matching/dense/CellView.h"
#include "matching/dense/DenseVerifier.h"
#include "matching/dense/likelihood_table.h"

namespace sigloc
{
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kMaxShift = 0.5;  // [m] by which a refinement may move a pose
constexpr double kMaxTurn = 10.0 * M_PI / 180.0;  // [rad] by which a refinement may turn a pose
constexpr float kFirstRobustSigma = 0.25F;  // [m] scale of the Cauchy weight of step 1, eq. (6.6)
// [m] scale of the Cauchy weight of later steps, eq. (6.6)
constexpr auto kRobustSigma = static_cast<float>(kFineSigma);
constexpr double kHold = 0.05;  // keeps the directions that the returns leave open, eq. (6.7)
constexpr double kConverged = 1e-3;  // [m], [rad] size of a step that is the last

using Floats = std::array<float, CellView::Block::kSize>;  // one for each return of a block

/// The sums of (6.5) to (6.7) in the order (x, y, phi), taken in the robot frame. There the returns
/// and normals do not turn with the pose.
struct PullSums
{
  float xx = 0, xy = 0, xt = 0, yy = 0, yt = 0, tt = 0;  // weight times j jᵀ
  float gx = 0, gy = 0, gt = 0;  // weight times (a·e) j

  /// Adds `count` returns of a block that begins at `first`. `ex` and `ey` are their offsets from
  /// the ridge [m].
  void add(const DenseScan& scan, std::size_t first, std::size_t count, const Floats& weight,
           const Floats& ex, const Floats& ey)
  {
    WideFloat sxx{}, sxy{}, sxt{}, syy{}, syt{}, stt{}, sgx{}, sgy{}, sgt{};
    for (std::size_t i = 0; i < count; i += kWideFloats)
    {
      const std::size_t n = std::min(kWideFloats, count - i);
      WideFloat w, x, y, pull_xx, pull_xy, pull_yy, offset_x, offset_y;
      loadWide(&weight[i], n, w);
      loadWide(&scan.x[first + i], n, x);
      loadWide(&scan.y[first + i], n, y);
      loadWide(&scan.pull_xx[first + i], n, pull_xx);
      loadWide(&scan.pull_xy[first + i], n, pull_xy);
      loadWide(&scan.pull_yy[first + i], n, pull_yy);
      loadWide(&ex[i], n, offset_x);
      loadWide(&ey[i], n, offset_y);
      const WideFloat wxx = w * pull_xx;
      const WideFloat wxy = w * pull_xy;
      const WideFloat wyy = w * pull_yy;
      const WideFloat wxt = x * wxy - y * wxx;
      const WideFloat wyt = x * wyy - y * wxy;
      const WideFloat force_x = wxx * offset_x + wxy * offset_y;
      const WideFloat force_y = wxy * offset_x + wyy * offset_y;
      sxx += wxx;
      sxy += wxy;
      sxt += wxt;
      syy += wyy;
      syt += wyt;
      stt += x * wyt - y * wxt;
      sgx += force_x;
      sgy += force_y;
      sgt += x * force_y - y * force_x;
    }
    xx += sumOf(sxx);
    xy += sumOf(sxy);
    xt += sumOf(sxt);
    yy += sumOf(syy);
    yt += sumOf(syt);
    tt += sumOf(stt);
    gx += sumOf(sgx);
    gy += sumOf(sgy);
    gt += sumOf(sgt);
  }

  /// Returns the sum of the returns' weights (6.6).
  float explained() const { return xx + yy; }

  /// Returns the step of (6.7), by Cholesky. kHold keeps the system positive definite.
  std::array<double, 3> step() const
  {
    const double l00 = std::sqrt(kHold + static_cast<double>(xx));
    const double l10 = static_cast<double>(xy) / l00;
    const double l20 = static_cast<double>(xt) / l00;
    const double l11 = std::sqrt(kHold + static_cast<double>(yy) - l10 * l10);
    const double l21 = (static_cast<double>(yt) - l20 * l10) / l11;
    const double l22 = std::sqrt(kHold + static_cast<double>(tt) - l20 * l20 - l21 * l21);
    const double a = -static_cast<double>(gx) / l00;
    const double b = (-static_cast<double>(gy) - l10 * a) / l11;
    const double c = (-static_cast<double>(gt) - l20 * a - l21 * b) / l22;
    const double t = c / l22;
    const double y = (b - l21 * t) / l11;
    const double x = (a - l10 * y - l20 * t) / l00;
    return {x, y, t};
  }
};

/// Finds the vectors [m] from the nearest wall's ridge to the returns of a block, in the robot
/// frame, and their weights (6.6). The weight is 0 without a wall within 1.26 m.
void offsetsFromRidge(const CellView::Block& block, float resolution, const Placement& place,
                      std::size_t count, float robust_sigma, Floats& weight, Floats& ex, Floats& ey)
{
  const float inverse_square = 1.0F / (robust_sigma * robust_sigma);
  for (std::size_t i = 0; i < count; ++i)
  {
    const float mx = block.offsetX(i, resolution);
    const float my = block.offsetY(i, resolution);
    const float reached = block.distance(i) != DenseCell::kFar ? 1.0F : 0.0F;
    weight[i] = reached / (1.0F + (mx * mx + my * my) * inverse_square);
    ex[i] = place.c * mx + place.s * my;
    ey[i] = place.c * my - place.s * mx;
  }
}

SIGLOC_WIDE_VECTORS PullSums pullsAt(const CellView& cells, const DenseScan& scan,
                                     std::size_t returns, const Placement& place,
                                     float robust_sigma)
{
  PullSums sums;
  CellView::Block block;
  Floats weight;
  Floats ex;
  Floats ey;
  for (std::size_t first = 0; first < returns; first += CellView::Block::kSize)
  {
    const std::size_t count = std::min(CellView::Block::kSize, returns - first);
    block.fill(cells, place, &scan.x[first], &scan.y[first], count);
    offsetsFromRidge(block, cells.resolution(), place, count, robust_sigma, weight, ex, ey);
    sums.add(scan, first, count, weight, ex, ey);
  }
  return sums;
}

/// Returns the sums of (6.9) over the returns on walls, weighted by the fine likelihood.
SIGLOC_WIDE_VECTORS PullSums informationAt(const CellView& cells, const DenseScan& scan,
                                           const Placement& place)
{
  constexpr float kLeastLikelihood = 0.05F;
  const LikelihoodTable& likelihood = fineTable();
  PullSums sums;
  CellView::Block block;
  Floats weight;
  const Floats no_offset{};
  for (std::size_t first = 0; first < scan.size(); first += CellView::Block::kSize)
  {
    const std::size_t count = std::min(CellView::Block::kSize, scan.size() - first);
    block.fill(cells, place, &scan.x[first], &scan.y[first], count);
    for (std::size_t i = 0; i < count; ++i)
    {
      const float fine = likelihood[block.distance(i)];
      weight[i] = fine > kLeastLikelihood ? fine : 0.0F;
    }
    sums.add(scan, first, count, weight, no_offset, no_offset);
  }
  return sums;
}

/// Returns the information [1/m^2] of a return on a wall along the wall's normal: tau/sigma^2 of
/// (6.9).
double informationOfReturn(const DenseScan& scan)
{
  constexpr double kRangeSigma = 0.05;  // [m] of a return against the raster
  constexpr double kIndependentBeams = 40;  // count of all beams, because neighbours are correlated
  const double tempering = std::min(1.0, kIndependentBeams / static_cast<double>(scan.size() + 1));
  return tempering / (kRangeSigma * kRangeSigma);
}

/// Returns the pose after a step in the robot frame.
TPose2D movedBy(const TPose2D& pose, const Placement& place, const std::array<double, 3>& move)
{
  const auto c = static_cast<double>(place.c);
  const auto s = static_cast<double>(place.s);
  return {pose.x + c * move[0] - s * move[1], pose.y + s * move[0] + c * move[1],
          pose.phi + move[2]};
}

bool isLast(const std::array<double, 3>& move)
{
  return std::abs(move[0]) + std::abs(move[1]) < kConverged && std::abs(move[2]) < kConverged;
}

/// A pose that is being refined.
struct Refined
{
  explicit Refined(const TPose2D& at) : start(at.x, at.y, wrapToPi(at.phi)), pose(start) {}

  /// Returns the refined pose, or the start if that is too far away.
  TPose2D result() const
  {
    const TPose2D end(pose.x, pose.y, wrapToPi(pose.phi));
    const bool near = std::hypot(end.x - start.x, end.y - start.y) <= kMaxShift &&
                      std::abs(wrapToPi(end.phi - start.phi)) <= kMaxTurn;
    return near ? end : start;
  }

  TPose2D start;
  TPose2D pose;
  std::optional<float> explained;  // weights (6.6) after one step, if that was not the last
  bool converged = false;
};

/// Removes the poses whose weights (6.6) sum to less than `least` of `most`, the largest so far.
void dropHopeless(std::vector<Refined>& refined, float least, float& most)
{
  for (const Refined& one : refined) most = std::max(most, one.explained.value_or(0));
  const auto hopeless = [&](const Refined& one)
  { return one.explained && *one.explained < least * most; };
  refined.erase(std::remove_if(refined.begin(), refined.end(), hopeless), refined.end());
}
}  // namespace

TPose2D DenseVerifier::refine(const DenseScan& scan, const TPose2D& start, int steps,
                              std::size_t beams) const
{
  std::vector<TPose2D> poses{start};
  refineAll(scan, poses, steps, beams);
  return poses.front();
}

/// Refines several poses, one step of each in turn, so that the processor can work on one while
/// another waits for its sums. The second step gives the weights (6.6) of each pose. Poses below
/// `least` of the best, of this call or of those that share `most_weight`, are then left out.
void DenseVerifier::refineAll(const DenseScan& scan, std::vector<TPose2D>& poses, int steps,
                              std::size_t beams, float least, float* most_weight) const
{
  float own_most = 0;
  float& most = most_weight != nullptr ? *most_weight : own_most;
  const CellView cells(field_);
  const std::size_t count = std::min(beams, scan.size());
  std::vector<Refined> refined(poses.begin(), poses.end());
  for (int step = 0; step < steps; ++step)
  {
    const float robust_sigma = step == 0 ? kFirstRobustSigma : kRobustSigma;
    for (Refined& one : refined)
    {
      if (one.converged) continue;
      const Placement place(one.pose);
      const PullSums sums = pullsAt(cells, scan, count, place, robust_sigma);
      const std::array<double, 3> move = sums.step();
      one.pose = movedBy(one.pose, place, move);
      one.converged = isLast(move);
      if (step == 1) one.explained = sums.explained();
    }
    if (step == 1) dropHopeless(refined, least, most);
  }
  poses.clear();
  for (const Refined& one : refined) poses.push_back(one.result());
}

mrpt::math::CMatrixDouble33 DenseVerifier::covarianceAt(const DenseScan& scan,
                                                        const TPose2D& pose) const
{
  constexpr double kOpenSigma = 5.0;  // [m] prior of a direction that nothing fixes, eq. (6.9)
  const PullSums sums = informationAt(CellView(field_), scan, Placement(pose));
  Eigen::Matrix3f in_robot;
  in_robot << sums.xx, sums.xy, sums.xt, sums.xy, sums.yy, sums.yt, sums.xt, sums.yt, sums.tt;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(pose.phi).toRotationMatrix();
  Eigen::Matrix3d information = turn * in_robot.cast<double>() * turn.transpose();
  information *= informationOfReturn(scan);
  information(0, 0) += 1.0 / (kOpenSigma * kOpenSigma);
  information(1, 1) += 1.0 / (kOpenSigma * kOpenSigma);
  information(2, 2) += 1.0 / (0.2 * 0.2);
  const Eigen::Matrix3d covariance = information.inverse();
  mrpt::math::CMatrixDouble33 out;
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c) out(r, c) = 0.5 * (covariance(r, c) + covariance(c, r));
  }
  return out;
}

/// Returns on no particular wall seem to fix a pose along a corridor, and so does furniture that
/// was moved to where something else was mapped. Their information must therefore show in the fit.
mrpt::math::CMatrixDouble33 DenseVerifier::testedCovarianceAt(const DenseScan& scan,
                                                              const TPose2D& pose) const
{
  constexpr double kMove = kFineSigma;  // [m] of the test
  constexpr double kUntestedSigma = 0.1;  // [m] where the fit gets no worse at all
  const double loss_of_return = 1.0 - std::exp(-0.5);  // of a return that the move takes off a wall
  mrpt::math::CMatrixDouble33 covariance = covarianceAt(scan, pose);
  const Eigen::Matrix2d position = covariance.asEigen().topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(position);
  const double widest = axes.eigenvalues()[1];
  const Eigen::Vector2d along = axes.eigenvectors().col(1);
  const auto fit_after = [&](double move) {
    return fineLikelihood(scan, {pose.x + move * along[0], pose.y + move * along[1], pose.phi});
  };
  const double loss = fit_after(0) - std::max(fit_after(kMove), fit_after(-kMove));
  const double missed = std::max(0.0, loss / loss_of_return);
  const double variance =
      1.0 / (missed * informationOfReturn(scan) + 1.0 / (kUntestedSigma * kUntestedSigma));
  if (variance <= widest) return covariance;
  const Eigen::Matrix2d more = (variance - widest) * along * along.transpose();
  for (int r = 0; r < 2; ++r)
  {
    for (int c = 0; c < 2; ++c) covariance(r, c) += more(r, c);
  }
  return covariance;
}
}  // namespace sigloc
