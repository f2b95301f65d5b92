// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "matching/dense/DenseVerifier.h"

namespace sigloc
{
namespace
{
/// The scan of two parallel walls, to the left and to the right of the laser.
ObservedScene betweenWalls(double left, double right)
{
  constexpr int kBeams = 720;
  ObservedScene scene;
  scene.sensor_origins = {{0, 0}};
  for (int i = 0; i < kBeams; ++i)
  {
    const double angle = -M_PI + 2 * M_PI * (i + 0.5) / kBeams;
    const double range = (angle > 0 ? left : right) / std::abs(std::sin(angle));
    if (range > 20) continue;
    scene.beams.push_back({{range * std::cos(angle), range * std::sin(angle)}, 0});
  }
  return scene;
}

TEST(DenseScan, BalanceLiesHalfwayBetweenReturnsAndStretchesOfWall)
{
  const DenseScan scan = makeDenseScan(betweenWalls(1.0, 4.0), 720);
  double near = 0;
  double far = 0;
  std::size_t near_returns = 0;
  std::size_t far_returns = 0;
  for (std::size_t i = 0; i < scan.size(); ++i)
  {
    // There returns of either wall lie less than 0.2 m apart.
    if (std::abs(scan.x[i]) > 3) continue;
    (scan.y[i] > 0 ? near : far) += static_cast<double>(scan.balance[i]);
    ++(scan.y[i] > 0 ? near_returns : far_returns);
  }
  EXPECT_GT(near_returns, 1.5 * static_cast<double>(far_returns));
  const double of_returns = static_cast<double>(near_returns) / static_cast<double>(far_returns);
  EXPECT_NEAR(near / far, std::sqrt(of_returns), 0.1 * std::sqrt(of_returns));
}

TEST(DenseScan, BalancedWeightsAreOneInTheMean)
{
  for (const double right : {0.5, 2.0, 9.0})
  {
    const DenseScan scan = makeDenseScan(betweenWalls(1.5, right), 400);
    const float sum = std::accumulate(scan.balance.begin(), scan.balance.end(), 0.0F);
    EXPECT_NEAR(sum / static_cast<float>(scan.size()), 1.0F, 1e-4F);
  }
}
}  // namespace
}  // namespace sigloc
