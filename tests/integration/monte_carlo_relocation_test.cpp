// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/poses/CPose3D.h>

#include "eval/methods/particles/MonteCarloSettings.h"
#include "eval/methods/RelocationMethod.h"
#include "eval/scoring/relocation_scoring.h"
#include "eval/worlds/simulation_files.h"
#include "sigloc/io/map_files.h"
#include "support/office_files.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

class MonteCarloRelocationTest : public ::testing::Test
{
 protected:
  MonteCarloRelocationTest() : map_(readEvaluationMap(test::kOfficeMap))
  {
    const auto scans = std::get<std::vector<PosedScans>>(readMapSource(test::kOfficeMap));
    asked_ = scans[scans.size() / 2];
  }

  RelocationResult localize(const RelocationMethodOptions& options,
                            const std::string& name = "mcl") const
  {
    return makeRelocationMethod(name, map_, options)->localize(asked_.scans);
  }

  /// The logarithm of the likelihood of the scan by MRPT's own map, at a pose.
  double likelihoodAt(const TPose2D& pose) const
  {
    mrpt::obs::CSensoryFrame frame;
    for (const LaserScan& scan : asked_.scans) frame.insert(toRangeScan(scan, 0));
    const auto maps = localizationMapOf(map_, toIni({}));
    const mrpt::poses::CPose3D at{mrpt::poses::CPose2D(pose)};
    return maps->computeObservationsLikelihood(frame, at);
  }

  EvaluationMap map_;
  PosedScans asked_;
};

TEST_F(MonteCarloRelocationTest, FindsARobotThatIsKnownToBeNear)
{
  RelocationMethodOptions options;
  const TPose2D& truth = asked_.map_from_robot;
  options.region = PoseRegion{truth.x - 1, truth.x + 1, truth.y - 1, truth.y + 1, truth.phi, 0.5};
  for (const char* name : {"mcl", "mcl-tuned"})
  {
    const RelocationResult found = localize(options, name);
    ASSERT_FALSE(found.candidates.empty());
    EXPECT_TRUE(isRight(errorBetween(found.candidates.front().pose.mean, truth), {})) << name;
    EXPECT_GE(found.counters.poses_scored, 40000U);
  }
}

TEST_F(MonteCarloRelocationTest, RanksClustersByTheirWeight)
{
  const RelocationResult found = localize({});
  ASSERT_GT(found.candidates.size(), 1U);
  ASSERT_LE(found.candidates.size(), 10U);
  double sum = 0;
  for (std::size_t i = 0; i < found.candidates.size(); ++i)
  {
    sum += found.candidates[i].probability;
    if (i == 0) continue;
    EXPECT_LE(found.candidates[i].probability, found.candidates[i - 1].probability);
  }
  EXPECT_LE(sum, 1 + 1e-9);
}

TEST_F(MonteCarloRelocationTest, WeighsByMrptsOwnLikelihood)
{
  // With two particles, each is a cluster of its own.
  RelocationMethodOptions options;
  options.particles = 2;
  const RelocationResult found = localize(options);
  ASSERT_EQ(found.candidates.size(), 2U);
  const double ratio =
      likelihoodAt(found.candidates[0].pose.mean) - likelihoodAt(found.candidates[1].pose.mean);
  EXPECT_NEAR(std::log(found.candidates[0].probability / found.candidates[1].probability), ratio,
              1e-3 * std::max(1.0, std::abs(ratio)));
}

TEST_F(MonteCarloRelocationTest, DependsOnScanMapAndSeedAlone)
{
  RelocationMethodOptions options;
  options.particles = 500;
  const auto method = makeRelocationMethod("mcl", map_, options);
  const TPose2D first = method->localize(asked_.scans).candidates.front().pose.mean;
  PosedScans other = asked_;
  other.scans.front().ranges.front() += 0.5F;
  method->localize(other.scans);
  EXPECT_EQ(method->localize(asked_.scans).candidates.front().pose.mean, first);
  options.seed = 2;
  EXPECT_NE(localize(options).candidates.front().pose.mean, first);
}
}  // namespace
}  // namespace sigloc
