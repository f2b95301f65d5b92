// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/landmarks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "bridge/rawlog_files.h"
#include "eval/data/landmark_data.h"
#include "eval/methods/feature_methods.h"
#include "eval/protocols/scale.h"
#include "eval/worlds/FeatureWorld.h"
#include "features/LocalMap.h"
#include "geometry/symmetric_matrix.h"
#include "support/landmark_log.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

/// Drives a straight line through a world of points with noisy odometry.
struct Drive
{
  FeatureWorldOptions options;
  FeatureWorld world;
  LocalMap local;
  TPose2D truth;

  explicit Drive(std::uint64_t seed, double spurious)
  {
    Random random(seed);
    options.range = 5;
    options.spurious = spurious;
    world = makeFeatureWorld(200, options, random);
    truth = TPose2D(10, 20, 0.3);
    MotionIncrement motion;
    motion.covariance = toMatrix({1e-4, 0, 0, 1e-4, 0, 4e-4});
    for (int step = 0; step < 15; ++step)
    {
      if (step > 0)
      {
        const TPose2D increment(0.3, 0, 0.02);
        truth = truth + increment;
        motion.mean = increment + TPose2D(0.01 * random.normal(), 0.01 * random.normal(),
                                          0.02 * random.normal());
      }
      local.add(motion, observeFeatures(world, truth, options, random));
    }
  }
};

TEST(LocalMap, GathersEachPlaceOnceAndSharply)
{
  const Drive drive(31, 0.0);
  EXPECT_EQ(drive.local.steps(), 15U);
  EXPECT_NEAR(drive.local.travelled(), 14 * 0.3, 0.2);
  const std::vector<Feature> gathered = drive.local.features();
  std::vector<std::size_t> owners;
  double squares = 0;
  for (const Feature& feature : gathered)
  {
    const Feature placed = transformed(drive.truth, feature);
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < drive.world.truth.size(); ++k)
    {
      const auto distance = [&](std::size_t i)
      { return (drive.world.truth[i].position - placed.position).norm(); };
      if (distance(k) < distance(nearest)) nearest = k;
    }
    EXPECT_LT((drive.world.truth[nearest].position - placed.position).norm(), 0.35);
    owners.push_back(nearest);
    const auto off = drive.world.truth[nearest].position - placed.position;
    const auto& p = placed.position_covariance;
    squares += squaredNorm(off.x, off.y, {p(0, 0), p(0, 1), p(1, 1)}) /
               static_cast<double>(gathered.size());
  }
  EXPECT_GT(gathered.size(), 5U);
  std::sort(owners.begin(), owners.end());
  EXPECT_EQ(std::adjacent_find(owners.begin(), owners.end()), owners.end()) << "seen twice";
  EXPECT_LT(squares, 4.0) << "covariances claim too much";
}

TEST(LocalMap, ForgetsWhatIsSeenOnlyOnce)
{
  Drive drive(32, 0.3);
  const auto once = drive.local.features(1).size();
  const auto twice = drive.local.features(2).size();
  // Spurious features of the last steps are still there, older ones are not.
  EXPECT_LT(once - twice, 6U * 4U);
}

TEST(FeatureMethods, EveryMethodFindsARobotInThePointWorld)
{
  FeatureWorldOptions options;
  Random random(33);
  const FeatureWorld world = makeFeatureWorld(300, options, random);
  const FeatureMap map(world.mapped);
  for (const char* name : {"signature", "signature-anchors", "signature-pairs",
                           "signature-patterns", "jcbb", "clique"})
  {
    const auto method = makeFeatureMethod(name, map, {});
    int right = 0;
    for (int k = 0; k < 5; ++k)
    {
      const TPose2D truth = randomPose(world, options, random);
      MatchingCounters counters;
      const auto found = method->generate(observeFeatures(world, truth, options, random), counters);
      right += !found.empty() &&
               std::hypot(found[0].pose.mean.x - truth.x, found[0].pose.mean.y - truth.y) < 0.3;
      EXPECT_GT(counters.hypotheses, 0U);
    }
    EXPECT_GE(right, 4) << name;
  }
  EXPECT_THROW(makeFeatureMethod("nonsense", map, {}), std::invalid_argument);
}

TEST(Scale, OperationsOfAnchorsAreLinearInTheMap)
{
  ScaleOptions options;
  options.map_features = {500, 1000, 2000};
  options.methods = {"signature-anchors", "signature-patterns"};
  options.poses = 20;
  options.slow_poses = 3;
  const ScaleReport report = runScale(options);
  ASSERT_EQ(report.rows.size(), 6U);
  std::vector<std::pair<double, double>> operations;
  for (const ScaleRow& row : report.rows)
  {
    EXPECT_GE(share(&Outcome::right)(row).value(), 0.95) << row.method;
    if (row.method != "signature-anchors") continue;
    operations.emplace_back(static_cast<double>(row.map_features), row.operations());
  }
  EXPECT_LT(fitExponent(operations).slope, 1.15);
  EXPECT_NE(scaleTable(report).find("signature-patterns"), std::string::npos);
  options.methods = {"nonsense"};
  EXPECT_THROW(runScale(options), std::invalid_argument);
}

TEST(Scale, ExponentOfAPowerLaw)
{
  const FittedExponent fit = fitExponent({{1, 3}, {2, 12}, {4, 48}, {8, 192}});
  EXPECT_NEAR(fit.slope, 2, 1e-9);
  EXPECT_NEAR(fit.low, fit.high, 1e-6);
}

TEST(Scale, IntervalOfAnExponentHasStudentsQuantile)
{
  // Residuals of (e, -2 e, e) over x = (0, 1, 2): slope variance 6 e^2 / 1 / 2, quantile 12.706.
  const double e = 0.01;
  const auto at = [](double x, double y) { return std::pair{std::exp(x), std::exp(y)}; };
  const FittedExponent fit = fitExponent({at(0, e), at(1, 1 - 2 * e), at(2, 2 + e)});
  EXPECT_NEAR(fit.slope, 1, 1e-9);
  EXPECT_NEAR(fit.high - fit.slope, 12.7062 * std::sqrt(3.0) * e, 1e-4);
  EXPECT_NEAR(fit.slope - fit.low, fit.high - fit.slope, 1e-9);
  EXPECT_TRUE(std::isinf(fitExponent({at(0, 0), at(1, 1)}).high));
}

TEST(Landmarks, TheMapHoldsWhatHasAnIdentityEvenIfSeenOnce)
{
  LandmarkData data;
  for (int k = 0; k < 3; ++k)
  {
    LandmarkStep step;
    step.truth = {static_cast<double>(k), 0, 0};
    Feature disc;
    disc.position = {1.0 + 0.1 * k, 0};
    disc.position_covariance.setIdentity();
    step.observed = {disc, disc, disc};
    step.identities = {7, 10 + k, -1};
    data.steps.push_back(step);
  }
  const std::vector<Feature> map = mapFromSteps(data, 2);
  ASSERT_EQ(map.size(), 3U);  // 7, 10 and 11; neither -1 nor what came later
  EXPECT_EQ(map[0].sightings, 2U);
  EXPECT_NEAR(map[0].position.x, 0.5 * (1.0 + 2.1), 1e-9);
  EXPECT_NEAR(map[0].position_covariance(0, 0), 0.5, 1e-9);
  EXPECT_EQ(map[1].sightings, 1U);
}

/// Writes a park of two trees and two scans: the vehicle turns on the spot of its odometry.
void writePark(const std::filesystem::path& folder, double turn, double truth_sigma)
{
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "map_trees.csv")
      << "# id,x,y,radius,var\n1,5,0,0.6,0.01\n2,5,9,0.4,0.01\n";
  std::ofstream covariance(folder / "map_P_290x290.csv");
  for (int row = 0; row < 4; ++row) covariance << "0.01,0,0,0.01\n";
  std::ofstream scans(folder / "scans_361_cm.csv");
  for (int scan = 0; scan < 2; ++scan)
  {
    for (int beam = 0; beam < 361; ++beam)
    {
      // A trunk of 0.3 m radius, 5 m straight ahead.
      const double angle = (beam - 180) * M_PI / 360;
      const double off = 5 * std::sin(angle);
      const double range =
          std::abs(off) < 0.3 ? 5 * std::cos(angle) - std::sqrt(0.09 - off * off) : 81.91;
      scans << (beam > 0 ? "," : "") << std::lround(100 * range);
    }
    scans << "\n";
  }
  const double variance = truth_sigma * truth_sigma;
  std::ofstream(folder / "vehicle_ground.csv")
      << "0,0,0,0,0,0,0,0,0\n"
      << 2.73 * std::cos(turn) - 2.73 + 0.67 * std::sin(turn) << ","
      << 2.73 * std::sin(turn) - 0.67 * std::cos(turn) + 0.67 << "," << turn << "," << variance
      << ",0,0," << variance << ",0,0\n";
  std::ofstream(folder / "vehicle_motion.csv")
      << "0,0,0,0,0,0,0,0,0\n0,0," << turn << ",0,0,0,0,0,0.0001\n";
}

TEST(Landmarks, TheParksTrunksHaveTheirWidthAndTheLaserItsOwnMotion)
{
  const auto folder = std::filesystem::temp_directory_path() / "sigloc-park";
  const double turn = 0.1;
  writePark(folder, turn, 0.2);
  const LandmarkData data = readVictoriaPark(folder);
  ASSERT_EQ(data.map.size(), 2U);
  ASSERT_EQ(data.steps.size(), 2U);
  // The first column of sizes holds diameters, and the scan agrees.
  EXPECT_NEAR(data.map[0].size, 0.3, 1e-9);
  ASSERT_EQ(data.steps[1].observed.size(), 1U);
  EXPECT_NEAR(data.steps[1].observed[0].size, data.map[0].size, 0.08);
  // The laser sits 2.7 m ahead of the point that turned, so it moved sideways.
  const MotionIncrement& motion = data.steps[1].motion;
  EXPECT_NEAR(motion.mean.x, data.steps[1].truth.x, 1e-6);
  EXPECT_NEAR(motion.mean.y, data.steps[1].truth.y, 1e-6);
  EXPECT_NEAR(motion.mean.y, 2.73 * turn, 0.02);
  EXPECT_NEAR(motion.covariance(1, 1), 0.0001 * 2.73 * 2.73, 1e-4);
  EXPECT_TRUE(data.steps[1].truth_sure);
}

TEST(Landmarks, ATruthThatDoubtsItselfOrJumpsIsNotSure)
{
  const auto folder = std::filesystem::temp_directory_path() / "sigloc-doubtful-park";
  writePark(folder, 0.1, 0.6);
  LandmarkData data = readVictoriaPark(folder);
  EXPECT_TRUE(data.steps[0].truth_sure);
  EXPECT_FALSE(data.steps[1].truth_sure);

  writePark(folder, 0.1, 0.2);
  std::ofstream(folder / "vehicle_motion.csv") << "0,0,0,0,0,0,0,0,0\n0,0,0,0,0,0,0,0,0.0001\n";
  data = readVictoriaPark(folder);
  EXPECT_FALSE(data.steps[0].truth_sure) << "it turned by 6 degrees, the odometry did not";
  EXPECT_FALSE(data.steps[1].truth_sure);
}

TEST(Landmarks, MissingFilesAndUnknownSetsAreNamed)
{
  LandmarksOptions options;
  options.path = "/nonexistent";
  try
  {
    runLandmarks(options);
    FAIL() << "no error";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_NE(std::string(error.what()).find("/nonexistent"), std::string::npos);
  }
  options.dataset = "nonsense";
  EXPECT_THROW(runLandmarks(options), std::invalid_argument);
}
/// The message of reading the log after `bad` was added to one of its files.
std::string complaintAbout(const char* file, const std::string& bad)
{
  const test::TemporaryFolder folder;
  test::writeTwoRounds(folder.path());
  std::ofstream(folder / file, std::ios::app) << bad;
  try
  {
    readDlr(folder.path());
  }
  catch (const std::runtime_error& error)
  {
    const std::string text = error.what();
    const std::string path = (folder / file).string() + ": ";
    EXPECT_EQ(text.rfind(path, 0), 0U) << text;
    return text.substr(std::min(path.size(), text.size()));
  }
  return "nothing";
}

TEST(LandmarkData, NamesTheLineOfABadRow)
{
  EXPECT_EQ(complaintAbout("dlr_ls_poses.csv", "201,1,x,3\n"), "line 201: 'x' is no number");
  EXPECT_EQ(complaintAbout("dlr_ls_poses.csv", "# 201\n201,1,2\n"), "line 202: 3 of 4 columns");
  EXPECT_EQ(complaintAbout("dlr_ls_landmarks.csv", "7,nan,2\n"), "line 91: 'nan' is no number");
  EXPECT_EQ(complaintAbout("dlr_ls_landmarks.csv", ""), "nothing");
  const std::string step = complaintAbout("map.circles", "STEP image 1 2\n");
  EXPECT_NE(step.find(": 2 of 9 columns"), std::string::npos) << step;
  const std::string landmark = complaintAbout("map.circles", "LANDMARK_C 1 2 0.9 a 0 1\n");
  EXPECT_NE(landmark.find(": 'a' is no number"), std::string::npos) << landmark;
}

TEST(LandmarkData, RefusesACovarianceThatIsTooSmallForItsMap)
{
  const test::TemporaryFolder folder;
  std::ofstream(folder / "map_trees.csv") << "1,2,3,0.3,0.01\n2,5,6,0.3,0.01\n";
  std::ofstream(folder / "map_P_290x290.csv") << "1,0,0,0\n0,1,0,0\n";
  EXPECT_THROW(readVictoriaPark(folder.path()), std::runtime_error);
}
}  // namespace
}  // namespace sigloc
