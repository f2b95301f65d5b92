// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/pose_fusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Dense>
#include <random>
#include <stdexcept>

#include "geometry/symmetric_matrix.h"

namespace sigloc
{
namespace
{
GaussianPose poseOf(double x, double y, double phi, const Symmetric3& covariance)
{
  return {{x, y, phi}, toMatrix(covariance)};
}

double smallestEigenvalue(const GaussianPose& pose)
{
  Eigen::Matrix3d m;
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c) m(r, c) = pose.covariance(r, c);
  }
  EXPECT_NEAR((m - m.transpose()).cwiseAbs().maxCoeff(), 0, 1e-15);
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvalues()[0];
}

GaussianPose randomPose(std::mt19937_64& random)
{
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::Matrix3d a;
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c) a(r, c) = uniform(random);
  }
  const Eigen::Matrix3d m = a * a.transpose() + 1e-6 * Eigen::Matrix3d::Identity();
  return poseOf(5 * uniform(random), 5 * uniform(random), M_PI * uniform(random),
                {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)});
}

TEST(PoseFusion, EqualCovariancesMeetHalfWay)
{
  const Symmetric3 p{0.04, 0, 0, 0.09, 0, 0.01};
  const GaussianPose fused = fusePoses(poseOf(1, 2, 0.2, p), poseOf(2, 4, 0.4, p));
  EXPECT_NEAR(fused.mean.x, 1.5, 1e-12);
  EXPECT_NEAR(fused.mean.y, 3.0, 1e-12);
  EXPECT_NEAR(fused.mean.phi, 0.3, 1e-12);
  EXPECT_NEAR(fused.covariance(0, 0), 0.02, 1e-12);
  EXPECT_NEAR(fused.covariance(1, 1), 0.045, 1e-12);
  EXPECT_NEAR(fused.covariance(2, 2), 0.005, 1e-12);
}

TEST(PoseFusion, ScalarTextbookCase)
{
  // Variances 4 and 1: the gain is 4 / 5, the variance 4 / 5.
  const GaussianPose fused =
      fusePoses(poseOf(0, 0, 0, {4, 0, 0, 4, 0, 4}), poseOf(1, 0, 0, {1, 0, 0, 1, 0, 1}));
  EXPECT_NEAR(fused.mean.x, 0.8, 1e-12);
  EXPECT_NEAR(fused.covariance(0, 0), 0.8, 1e-12);
}

TEST(PoseFusion, HeadingsMeetAcrossTheWrap)
{
  const Symmetric3 p{1, 0, 0, 1, 0, 0.01};
  const GaussianPose fused = fusePoses(poseOf(0, 0, 3.1, p), poseOf(0, 0, -3.1, p));
  EXPECT_NEAR(std::abs(fused.mean.phi), M_PI, 1e-9);
  const GaussianPose merged = mergeByMoments(poseOf(0, 0, 3.1, p), 1, poseOf(0, 0, -3.1, p), 1);
  EXPECT_NEAR(std::abs(merged.mean.phi), M_PI, 1e-9);
  const double half_gap = M_PI - 3.1;
  EXPECT_NEAR(merged.covariance(2, 2), 0.01 + half_gap * half_gap, 1e-12);
}

TEST(PoseFusion, CommutesShrinksAndStaysPositiveDefinite)
{
  std::mt19937_64 random(42);
  for (int k = 0; k < 200; ++k)
  {
    const GaussianPose a = randomPose(random);
    GaussianPose b = randomPose(random);
    b.mean.phi = std::remainder(a.mean.phi + 0.3, 2 * M_PI);
    const GaussianPose ab = fusePoses(a, b);
    const GaussianPose ba = fusePoses(b, a);
    EXPECT_NEAR(ab.mean.x, ba.mean.x, 1e-6);
    EXPECT_NEAR(ab.mean.y, ba.mean.y, 1e-6);
    EXPECT_NEAR(ab.covariance(0, 1), ba.covariance(0, 1), 1e-9);
    EXPECT_GT(smallestEigenvalue(ab), 0);
    for (int d = 0; d < 3; ++d) EXPECT_LE(ab.covariance(d, d), a.covariance(d, d) + 1e-12);
    EXPECT_LE(std::abs(ab.mean.phi), M_PI + 1e-12);
    EXPECT_GT(smallestEigenvalue(mergeByMoments(a, 0.3, b, 0.7)), 0);
  }
}

TEST(PoseFusion, RefusesCovariancesThatAreNone)
{
  const GaussianPose flat = poseOf(0, 0, 0, {});
  EXPECT_THROW(fusePoses(flat, flat), std::invalid_argument);
  EXPECT_THROW(mergeByMoments(flat, 0, flat, 0), std::invalid_argument);
  EXPECT_NO_THROW(fusePoses(flat, poseOf(1, 0, 0, {1, 0, 0, 1, 0, 1})));
}

TEST(PoseFusion, MergingKeepsMeanAndSpreadOfTheMixture)
{
  const Symmetric3 p{0.1, 0, 0, 0.1, 0, 0.01};
  const GaussianPose merged = mergeByMoments(poseOf(0, 0, 0, p), 3, poseOf(4, 0, 0, p), 1);
  EXPECT_NEAR(merged.mean.x, 1.0, 1e-12);
  EXPECT_NEAR(merged.covariance(0, 0), 0.1 + 0.75 * 0.25 * 16, 1e-12);
  EXPECT_NEAR(merged.covariance(1, 1), 0.1, 1e-12);
}

TEST(PoseFusion, LargestSigmaIsThatOfTheLongAxis)
{
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  const Symmetric2 turned = rotated({4, 0, 0.25}, c, s);
  EXPECT_NEAR(largestPositionSigma(poseOf(0, 0, 0, {turned.xx, turned.xy, 0, turned.yy, 0, 9})),
              2.0, 1e-12);
}
}  // namespace
}  // namespace sigloc
