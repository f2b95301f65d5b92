// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>
#include <utility>

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

// A wall right beside the laser once outweighed the rest of the room in every score.
TEST(DenseScan, SpacedReturnsCountStretchesOfWallAlike)
{
  const ObservedScene scene = betweenWalls(0.4, 4.0);
  const DenseScan scan = makeDenseScan(scene, 720);
  ASSERT_EQ(scan.size(), scene.beams.size());
  ASSERT_LT(scan.spaced, scan.size());
  double near = 0;
  double far = 0;
  for (std::size_t i = 0; i < scan.spaced; ++i)
  {
    // Within this stretch returns of either wall lie at most 0.1 m apart.
    if (std::abs(scan.x[i]) > 1.5) continue;
    ++(scan.y[i] > 0 ? near : far);
  }
  EXPECT_NEAR(near, 30, 4);  // 3 m of wall, one for each 0.1 m
  EXPECT_NEAR(far, 30, 4);
}

TEST(DenseScan, TakesEveryReturnOnce)
{
  for (const std::size_t most : {10U, 50U, 400U, 720U})
  {
    const ObservedScene scene = betweenWalls(0.4, 4.0);
    const DenseScan scan = makeDenseScan(scene, most);
    EXPECT_EQ(scan.size(), std::min(most, scene.beams.size()));
    EXPECT_LE(scan.spaced, scan.size());
    std::set<std::pair<float, float>> points;
    for (std::size_t i = 0; i < scan.size(); ++i) points.insert({scan.x[i], scan.y[i]});
    EXPECT_EQ(points.size(), scan.size());
  }
}
}  // namespace
}  // namespace sigloc
