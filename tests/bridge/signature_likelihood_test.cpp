// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBearingRange.h>

#include <cmath>
#include <thread>
#include <vector>

#include "bridge/room_map.h"

using namespace sigloc;
using namespace sigloc::test;
using mrpt::poses::CPose3D;

TEST(SignatureMap, LikelihoodPeaksAtTheTruePose)
{
  const SignatureMap map = roomMap();
  const auto scan = roomScan({0.5, -0.3, 0.4}, 7);
  const auto at = [&](double x, double y, double phi)
  { return map.computeObservationLikelihood(*scan, CPose3D(x, y, 0, phi, 0, 0)); };
  const double best = at(0.5, -0.3, 0.4);
  EXPECT_LE(best, 0.0);
  EXPECT_GT(best, at(0.9, -0.3, 0.4));
  EXPECT_GT(best, at(0.5, 0.2, 0.4));
  EXPECT_GT(best, at(0.5, -0.3, 0.8));
  EXPECT_GT(best, at(50, 50, 0.4));
}

TEST(SignatureMap, LikelihoodFollowsAnObservationThatChangesInPlace)
{
  const SignatureMap map = roomMap();
  const CPose3D pose(0.5, -0.3, 0, 0.4, 0, 0);
  auto scan = roomScan({0.5, -0.3, 0.4});
  const double before = map.computeObservationLikelihood(*scan, pose);
  *scan = *roomScan({-1.5, 1.0, 0.4});
  EXPECT_LT(map.computeObservationLikelihood(*scan, pose), before);
}

TEST(SignatureMap, LikelihoodFollowsAllThatItDependsOn)
{
  SignatureMap map = roomMap();
  const CPose3D pose(0.5, -0.3, 0, 0.4, 0, 0);
  auto scan = roomScan({0.5, -0.3, 0.4});
  double before = map.computeObservationLikelihood(*scan, pose);
  const auto expectAnother = [&](const char* changed)
  {
    const double now = map.computeObservationLikelihood(*scan, pose);
    EXPECT_NE(now, before) << changed;
    before = now;
  };
  scan->sensorPose = {0, 0.3, 0, 0, 0, 0};
  expectAnother("sensor pose");
  scan->aperture = 5.0F;
  expectAnother("aperture");
  scan->rightToLeft = false;
  expectAnother("direction");
  scan->maxRange = 3.0F;
  expectAnother("range");
  for (std::size_t i = 0; i < 100; ++i) scan->setScanRangeValidity(i, false);
  expectAnother("validity");
  map.likelihood_options.points.max_points = 7;
  expectAnother("points");

  mrpt::obs::CObservationBearingRange seen;
  seen.sensedData.push_back({2.5F, 0.0F, 0.0F, -1, {}});
  const SignatureMap walls{FeatureMap(map.featureMap()->features())};
  const double ahead = walls.computeObservationLikelihood(seen, CPose3D());
  seen.sensedData[0].yaw = static_cast<float>(M_PI / 2);
  const double aside = walls.computeObservationLikelihood(seen, CPose3D());
  EXPECT_GT(aside, ahead) << "where a wall is";
  seen.sensorLocationOnRobot = {0, -1, 0, 0, 0, 0};
  EXPECT_LT(walls.computeObservationLikelihood(seen, CPose3D()), aside);
}

TEST(SignatureMap, WeighsLandmarksOfAMapWithoutField)
{
  std::vector<Feature> trees(3);
  trees[0].position = {5, 0};
  trees[1].position = {0, 5};
  trees[2].position = {-4, -1};
  for (Feature& tree : trees)
  {
    tree.position_covariance(0, 0) = tree.position_covariance(1, 1) = 0.01;
  }
  const SignatureMap map{FeatureMap(trees)};
  mrpt::obs::CObservationBearingRange seen;
  seen.sensedData.resize(2);
  seen.sensedData[0] = {5.0F, 0.0F, 0.0F, -1, {}};
  seen.sensedData[1] = {5.0F, static_cast<float>(M_PI / 2), 0.0F, -1, {}};
  const double right = map.computeObservationLikelihood(seen, CPose3D());
  EXPECT_GT(right, map.computeObservationLikelihood(seen, CPose3D(0.5, 0, 0, 0, 0, 0)));
  EXPECT_GT(right, map.computeObservationLikelihood(seen, CPose3D(0, 0, 0, 1, 0, 0)));
}

TEST(SignatureMap, GivesThreadsTheSameLikelihoods)
{
  const SignatureMap map = roomMap();
  const auto scan = roomScan({0.5, -0.3, 0.4});
  const auto sum_over_poses = [&]
  {
    double sum = 0;
    for (int i = 0; i < 500; ++i)
    {
      sum += map.computeObservationLikelihood(*scan, CPose3D(0.002 * i, 0, 0, 0.4, 0, 0));
    }
    return sum;
  };
  std::vector<double> sums(4);
  std::vector<std::thread> threads;
  threads.reserve(sums.size());
  for (double& sum : sums) threads.emplace_back([&] { sum = sum_over_poses(); });
  for (auto& thread : threads) thread.join();
  for (const double sum : sums) EXPECT_EQ(sum, sums.front());
}
