// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "bridge/rawlog_files.h"
#include "sigloc/eval/Random.h"
#include "sigloc/eval/scale.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using test::TemporaryFolder;

constexpr double kStep = 0.4;  // [m]
constexpr int kStepsARound = 100;
constexpr std::size_t kDiscs = 90;

/// Two rounds on a circle among discs, as the DLR log's files have it: the robot's forward is -y.
void writeTwoRounds(const std::filesystem::path& folder)
{
  Random random(77);
  const double radius = kStep * kStepsARound / (2 * M_PI);
  const TPoint2D centre(radius, 0);
  std::vector<TPoint2D> discs(kDiscs);
  std::ofstream landmarks(folder / "dlr_ls_landmarks.csv");
  for (std::size_t i = 0; i < kDiscs; ++i)
  {
    const double angle = random.uniform(-M_PI, M_PI);
    const double from_centre = radius + random.uniform(-3, 3);
    discs[i] = centre + TPoint2D(std::cos(angle), std::sin(angle)) * from_centre;
    landmarks << i << "," << discs[i].x << "," << discs[i].y << "\n";
  }
  std::ofstream log(folder / "map.circles");
  std::ofstream poses(folder / "dlr_ls_poses.csv");
  const TPose2D increment(0, -kStep, 2 * M_PI / kStepsARound);
  TPose2D pose(0, 0, 0);
  for (int step = 1; step <= 2 * kStepsARound; ++step)
  {
    pose = pose + increment;
    poses << step << "," << pose.x << "," << pose.y << "," << pose.phi << "\n";
    log << "STEP image " << increment.x << " " << increment.y << " " << increment.phi
        << " 1e-5 0 1e-5 0 0 1e-5\n";
    for (std::size_t i = 0; i < kDiscs; ++i)
    {
      const TPoint2D seen = pose.inverseComposePoint(discs[i]);
      if (seen.norm() > 4) continue;
      log << "LANDMARK_C " << seen.x + 0.02 * random.normal() << " "
          << seen.y + 0.02 * random.normal() << " 0.9 0.0004 0 0.0004 " << i << "\n";
    }
  }
}

TEST(LandmarkGrowth, VariesTheMapAroundThePlaceAndThinsTheScene)
{
  const TemporaryFolder folder;
  writeTwoRounds(folder.path());
  ScaleOptions options;
  options.dlr = folder.path();
  options.map_features = {30, 60, 1000};
  options.observed = {6};
  options.methods = {"signature-anchors", "jcbb"};
  options.poses = 5;
  options.local_map_steps = 10;
  const ScaleReport report = runScale(options);
  ASSERT_EQ(report.rows.size(), 8U);
  for (std::size_t k = 0; k < 2; ++k)
  {
    const ScaleRow* rows = &report.rows[4 * k];
    const std::size_t whole = rows[2].map_features;
    EXPECT_EQ(rows[0].map_features, 30U);
    EXPECT_EQ(rows[1].map_features, 60U);
    EXPECT_GT(whole, 60U);
    EXPECT_LE(whole, kDiscs) << "no more than there are";
    EXPECT_EQ(rows[3].map_features, whole);
    EXPECT_DOUBLE_EQ(rows[3].observed, 6);
    for (std::size_t i = 0; i < 3; ++i)
    {
      EXPECT_EQ(rows[i].success.count, 5U) << rows[i].method << " in " << rows[i].map_features;
      EXPECT_GT(rows[i].observed, 8);
    }
    EXPECT_LT(rows[0].operations(), rows[2].operations());
  }
}
}  // namespace
}  // namespace sigloc
