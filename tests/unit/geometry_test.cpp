// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/geometry/GaussianPose.h"

#include <gtest/gtest.h>

#include "geometry/chi_square.h"
#include "geometry/PoseEstimate.h"
#include "geometry/symmetric_matrix.h"

namespace sigloc
{
namespace
{
GaussianPose examplePose()
{
  GaussianPose pose;
  pose.mean = {1.0, -2.0, 3.0};
  pose.covariance = toMatrix({0.04, 0.01, 0.002, 0.09, -0.003, 0.001});
  return pose;
}

TEST(ChiSquare, MatchesTables)
{
  EXPECT_NEAR(chiSquareGate(0.95, 1), 3.841459, 1e-5);
  EXPECT_NEAR(chiSquareGate(0.99, 2), 9.210340, 1e-5);
  EXPECT_NEAR(chiSquareGate(0.995, 3), 12.83816, 1e-4);
  EXPECT_NEAR(chiSquareGate(0.95, 100), 124.3421, 1e-3);
  EXPECT_THROW(chiSquareGate(1.0, 2), std::invalid_argument);
  EXPECT_THROW(chiSquareGate(0.9, 0), std::invalid_argument);
}

TEST(ChiSquare, TableContinuesBeyondItsEnd)
{
  const ChiSquareGates gates(0.99, 3);
  EXPECT_DOUBLE_EQ(gates(2), chiSquareGate(0.99, 2));
  EXPECT_DOUBLE_EQ(gates(7), chiSquareGate(0.99, 7));
}

TEST(SymmetricMatrix, InverseTimesMatrixIsIdentity)
{
  const Symmetric3 m{4, 1, 0.5, 3, -0.2, 2};
  const auto i = inverse(m);
  ASSERT_TRUE(i);
  EXPECT_NEAR(m.xx * i->xx + m.xy * i->xy + m.xt * i->xt, 1, 1e-12);
  EXPECT_NEAR(m.xx * i->xy + m.xy * i->yy + m.xt * i->yt, 0, 1e-12);
  EXPECT_NEAR(m.xt * i->xt + m.yt * i->yt + m.tt * i->tt, 1, 1e-12);
  EXPECT_FALSE(inverse(Symmetric3{1, 1, 0, 1, 0, 1}));
  EXPECT_FALSE(inverse(Symmetric3{}));
}

TEST(GaussianPose, CompositionMatchesNumericalJacobians)
{
  const GaussianPose pose = examplePose();
  MotionIncrement motion;
  motion.mean = {0.7, 0.2, 0.5};
  motion.covariance = toMatrix({0.01, 0.002, 0.001, 0.02, -0.001, 0.003});
  const GaussianPose sum = composeWithMotion(pose, motion);

  const auto compose = [](const double* v)
  { return mrpt::math::TPose2D(v[0], v[1], v[2]) + mrpt::math::TPose2D(v[3], v[4], v[5]); };
  const double at[6] = {1.0, -2.0, 3.0, 0.7, 0.2, 0.5};
  double jacobian[3][6];
  for (int c = 0; c < 6; ++c)
  {
    double up[6];
    double down[6];
    std::copy(at, at + 6, up);
    std::copy(at, at + 6, down);
    constexpr double kStep = 1e-6;
    up[c] += kStep;
    down[c] -= kStep;
    const auto a = compose(up);
    const auto b = compose(down);
    jacobian[0][c] = (a.x - b.x) / (2 * kStep);
    jacobian[1][c] = (a.y - b.y) / (2 * kStep);
    jacobian[2][c] = std::remainder(a.phi - b.phi, 2 * M_PI) / (2 * kStep);
  }
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c)
    {
      double expected = 0;
      for (int i = 0; i < 3; ++i)
      {
        for (int j = 0; j < 3; ++j)
        {
          expected += jacobian[r][i] * pose.covariance(i, j) * jacobian[c][j] +
                      jacobian[r][3 + i] * motion.covariance(i, j) * jacobian[c][3 + j];
        }
      }
      EXPECT_NEAR(sum.covariance(r, c), expected, 1e-8) << r << c;
    }
  }
  EXPECT_NEAR(sum.mean.phi, 3.5 - 2 * M_PI, 1e-12);
}

TEST(GaussianPose, MahalanobisDistanceWrapsTheHeading)
{
  GaussianPose a = examplePose();
  GaussianPose b = examplePose();
  a.mean.phi = M_PI - 0.01;
  b.mean.phi = -M_PI + 0.01;
  a.covariance = b.covariance = toMatrix({0.5, 0, 0, 0.5, 0, 0.5});
  EXPECT_NEAR(squaredMahalanobisDistance(a, b), 0.02 * 0.02, 1e-9);
  a.covariance.setZero();
  b.covariance.setZero();
  EXPECT_THROW(squaredMahalanobisDistance(a, b), std::invalid_argument);
}

TEST(PoseEstimate, KalmanUpdateEqualsInformationForm)
{
  PoseEstimate prior = toEstimate(examplePose());
  PlanarMeasurement m;
  m.residual = {0.1, -0.05};
  m.jacobian = {{{1, 0, 0.4}, {0, 1, -2.0}}};
  m.noise = {0.02, 0.005, 0.03};

  PoseEstimate filtered = prior;
  update(filtered, m);

  Symmetric3 information = *inverse(prior.covariance);
  std::array<double, 3> vector{};
  addInformation(m, information, vector);
  const Symmetric3 covariance = *inverse(information);
  EXPECT_NEAR(filtered.covariance.xx, covariance.xx, 1e-12);
  EXPECT_NEAR(filtered.covariance.yt, covariance.yt, 1e-12);
  EXPECT_NEAR(filtered.covariance.tt, covariance.tt, 1e-12);
  EXPECT_NEAR(filtered.x - prior.x,
              covariance.xx * vector[0] + covariance.xy * vector[1] + covariance.xt * vector[2],
              1e-12);
}
}  // namespace
}  // namespace sigloc
