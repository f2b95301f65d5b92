// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <mrpt/config/CConfigFile.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/version.h>

#include <cmath>
#include <Eigen/Dense>
#include <map>

#include "eval/methods/particles/MonteCarloSettings.h"
#include "eval/wakeup/wakeup.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc
{
namespace
{
const std::filesystem::path kShare = "/usr/share/mrpt";
const std::filesystem::path kShipped =
    kShare / "config_files/pf-localization/localization_demo.ini";
const std::filesystem::path kLog = kShare / "datasets/localization_demo.rawlog";

// Ours are those of MRPT 2.5.8, which the figures of the results are made with. MRPT 2.14 ships
// two others.
TEST(MonteCarlo, OptionsAreThoseThatPfLocalizationShips)
{
  const mrpt::config::CConfigFile shipped(kShipped.string());
  constexpr bool kLater = MRPT_VERSION >= 0x20E07;
  const std::map<std::string, double> changes = {{"LF_decimation", 10}, {"LF_stdHit", 0.4}};
  const mrpt::config::CConfigFileMemory ours(toIni(monteCarloSettings("mcl", 0, {})));
  std::vector<std::string> sections;
  ours.getAllSections(sections);
  ASSERT_EQ(sections.size(), 7U);
  for (const std::string& section : sections)
  {
    std::vector<std::string> keys;
    ours.getAllKeys(section, keys);
    ASSERT_FALSE(keys.empty()) << section;
    for (const std::string& key : keys)
    {
      const double expected = shipped.read_double(section, key, 0, /*failIfNotFound=*/true);
      const auto changed = changes.find(key);
      const bool differs = kLater && changed != changes.end();
      EXPECT_EQ(differs ? changed->second : ours.read_double(section, key, NAN), expected)
          << section << " " << key;
    }
  }
}

mrpt::obs::CActionRobotMovement2D movementOf(const RawlogStep& step,
                                             const MonteCarloSettings& settings)
{
  return *actionsOf(step, settings).getBestMovementEstimation();
}

TEST(MonteCarlo, MovesAsTheLogSays)
{
  RawlogReader reader(kLog);
  const RawlogStep step = reader.next().value();
  const auto logged = step.actions->getBestMovementEstimation();
  const auto [logged_covariance, logged_mean] = logged->poseChange->getCovarianceAndMean();
  MonteCarloSettings settings;
  const auto shipped = movementOf(step, settings).poseChange->getCovarianceAndMean();
  EXPECT_EQ(std::get<1>(shipped), logged_mean);
  EXPECT_LT((std::get<0>(shipped) - logged_covariance).asEigen().norm(), 1e-9);
  settings.own_odometry = OdometryNoise{0.2, 5};
  const auto own = movementOf(step, settings).poseChange->getCovarianceAndMean();
  EXPECT_EQ(std::get<1>(own), logged_mean);
  EXPECT_GE(std::get<0>(own)(0, 0), 0.2 * 0.2);
}

TEST(MonteCarlo, MovesByTheConfiguredNoiseWhereTheLogHasObservationsOnly)
{
  RawlogStep step;
  step.motion = MotionIncrement{};
  step.motion->mean = {0.3, 0, 0.1};
  const auto moved = movementOf(step, {}).poseChange->getCovarianceAndMean();
  EXPECT_NEAR(std::get<1>(moved).x(), 0.3, 1e-6);
  EXPECT_GE(std::get<0>(moved)(0, 0), 0.10 * 0.10);
}

TEST(MonteCarlo, SearchesTheMapThatPfLocalizationMakes)
{
  const auto map = readEvaluationMap(kShare / "datasets/localization_demo.simplemap.gz");
  const auto maps = localizationMapOf(map, toIni({}));
  const auto grid = maps->mapByClass<mrpt::maps::COccupancyGridMap2D>();
  EXPECT_NEAR(grid->getResolution(), 0.06, 1e-6);
  EXPECT_EQ(grid->likelihoodOptions.LF_decimation, 20U);
}

TEST(MonteCarlo, AGridsOwnLikelihoodOptionsDontCount)
{
  EvaluationMap map = readEvaluationMap(kShare / "datasets/2006-MalagaCampus.gridmap.gz");
  const auto maps = localizationMapOf(map, toIni({}));
  const auto grid = maps->mapByClass<mrpt::maps::COccupancyGridMap2D>();
  EXPECT_NEAR(grid->getResolution(), 0.08, 1e-6) << "the file's cells";
  EXPECT_EQ(grid->likelihoodOptions.LF_decimation, 20U) << "the file says 10";
}

TEST(MonteCarlo, TunedParticlesAreBounded)
{
  EXPECT_EQ(monteCarloSettings("mcl-tuned", 10, {}).particles, 40000U);
  EXPECT_EQ(monteCarloSettings("mcl-tuned", 500, {}).particles, 100000U);
  EXPECT_EQ(monteCarloSettings("mcl-tuned", 1e6, {}).particles, 200000U);
  EXPECT_EQ(monteCarloSettings("mcl-tuned", 1e6, {}).kld_maximum, 200000U);
}

TEST(MonteCarlo, TheBestUsesAllBeamsAndTempersThem)
{
  const MonteCarloSettings best = monteCarloSettings("mcl-best", 500, {});
  EXPECT_EQ(best.particles, monteCarloSettings("mcl-tuned", 500, {}).particles);
  EXPECT_TRUE(best.least_reliability);
  const mrpt::config::CConfigFileMemory ini(toIni(best));
  EXPECT_EQ(ini.read_int("MetricMap_occupancyGrid_00_likelihoodOpts", "LF_decimation", 0), 1);
  EXPECT_LT(ini.read_double("PF_options", "powFactor", 1), 1);
  RelocationMethodOptions options;
  options.tempering = 0.25;
  EXPECT_EQ(monteCarloSettings("mcl-best", 500, options).tempering, 0.25);
}

/// The first three metres of the office's drive.
WakeupOptions officeDrive()
{
  const std::filesystem::path source = SIGLOC_SOURCE_DIR;
  WakeupOptions options;
  options.map = source / "maps" / "office.simplemap";
  options.rawlog = source / "rawlogs" / "office.rawlog";
  options.ground_truth = source / "rawlogs" / "office-truth.txt";
  options.starts = 1;
  options.travel = 3;
  return options;
}

TEST(MonteCarlo, TheBestClaimsWhereTheScanIsReliable)
{
  WakeupOptions options = officeDrive();
  options.methods = {"signature"};
  const auto first = runWakeups(options).methods.front().runs.front().steps.front().claim.pose;
  options.methods = {"mcl-best"};
  options.method.particles = 2000;
  options.method.region =
      PoseRegion{first.x - 0.3, first.x + 0.3, first.y - 0.3, first.y + 0.3, first.phi, 0.2};
  std::size_t tight = 0;
  for (const WakeupStep& step : runWakeups(options).methods.front().runs.front().steps)
  {
    const double reliability = step.claim.reliability;
    if (std::isnan(reliability))
    {
      EXPECT_FALSE(step.claim.confident) << "judged only while tight";
      continue;
    }
    ++tight;
    EXPECT_EQ(step.claim.confident,
              reliability >= *monteCarloSettings("mcl-best", 0, {}).least_reliability);
  }
  EXPECT_GT(tight, 0U);
}

TEST(MonteCarlo, ProgramAndFilterFollowTheSameDrive)
{
  WakeupOptions options = officeDrive();
  options.methods = {"signature", "mcl", "mcl-stock"};
  options.method.particles = 2000;
  const auto first = runWakeups(options).methods.front().runs.front().steps.front().claim.pose;
  options.method.region =
      PoseRegion{first.x - 0.3, first.x + 0.3, first.y - 0.3, first.y + 0.3, first.phi, 0.2};
  const WakeupReport report = runWakeups(options);
  for (const WakeupMethodReport& method : report.methods)
  {
    const Wakeup& run = method.runs.front();
    EXPECT_EQ(run.steps.size(), report.methods.front().runs.front().steps.size()) << method.name;
    EXPECT_LT(run.steps.back().error.distance, 0.5) << method.name;
    EXPECT_TRUE(run.right_at_end) << method.name;
  }
}
}  // namespace
}  // namespace sigloc
