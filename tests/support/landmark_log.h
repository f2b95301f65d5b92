// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <vector>

namespace sigloc::test
{
inline constexpr double kStep = 0.4;  // [m]
inline constexpr int kStepsARound = 100;
inline constexpr std::size_t kDiscs = 90;

/// Two rounds on a circle among discs, as the DLR log's files have it: the robot's forward is -y.
inline void writeTwoRounds(const std::filesystem::path& folder)
{
  using mrpt::math::TPoint2D;
  using mrpt::math::TPose2D;
  std::mt19937 generator(77);
  std::normal_distribution<double> noise(0, 0.02);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double radius = kStep * kStepsARound / (2 * M_PI);
  const TPoint2D centre(radius, 0);
  std::vector<TPoint2D> discs(kDiscs);
  std::ofstream landmarks(folder / "dlr_ls_landmarks.csv");
  for (std::size_t i = 0; i < kDiscs; ++i)
  {
    const double angle = M_PI * uniform(generator);
    const double from_centre = radius + 3 * uniform(generator);
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
      log << "LANDMARK_C " << seen.x + noise(generator) << " " << seen.y + noise(generator)
          << " 0.9 0.0004 0 0.0004 " << i << "\n";
    }
  }
}
}  // namespace sigloc::test
