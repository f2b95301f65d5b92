// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "sigloc/tracking/HypothesisTracker.h"
#include "support/simulated_office.h"

namespace sigloc::test
{
constexpr std::uint64_t kOfficeSeed = 5;

/// The office that the tracker's tests drive through.
inline const MappedWorld& office()
{
  static const MappedWorld world(officeWorld(kOfficeSeed), kOfficeSeed);
  return world;
}

inline std::vector<DriveStep> driveThrough(const World& world, double metres, std::uint64_t seed)
{
  DriveOptions options;
  options.metres = metres;
  return simulateDrive(world, options, {}, MappedWorld::laser(), seed);
}

inline void expectWellFormed(const Belief& belief)
{
  double sum = belief.elsewhere;
  double last = 1;
  for (const TrackedHypothesis& hypothesis : belief.hypotheses)
  {
    sum += hypothesis.weight;
    EXPECT_GE(hypothesis.weight, 0);
    EXPECT_LE(hypothesis.weight, last + 1e-12);
    last = hypothesis.weight;
    const mrpt::math::TPose2D& pose = hypothesis.pose.mean;
    EXPECT_TRUE(std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.phi));
    EXPECT_LE(std::abs(pose.phi), M_PI + 1e-9);
    Eigen::Matrix3d m;
    for (int r = 0; r < 3; ++r)
    {
      for (int c = 0; c < 3; ++c) m(r, c) = hypothesis.pose.covariance(r, c);
    }
    EXPECT_NEAR((m - m.transpose()).cwiseAbs().maxCoeff(), 0, 1e-12);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvalues()[0], 0);
  }
  EXPECT_NEAR(sum, 1.0, 1e-9);
  EXPECT_GE(belief.probability, 0);
  EXPECT_LE(belief.probability, 1 + 1e-12);
  EXPECT_FALSE(belief.reason.empty());
}

/// The result of one drive.
struct Outcome
{
  bool right_at_end = false;
  bool wrong_while_confident = false;
  int confident_steps = 0;
  int steps = 0;
};

inline bool confidentlyWrong(const Belief& belief, const mrpt::math::TPose2D& truth)
{
  return belief.verdict == Verdict::localized &&
         !isRight(belief.hypotheses.front().pose.mean, truth);
}

inline Outcome follow(HypothesisTracker& tracker, const std::vector<DriveStep>& drive,
                      bool with_odometry = true)
{
  Outcome outcome;
  for (const DriveStep& step : drive)
  {
    const std::optional<MotionIncrement> motion =
        with_odometry ? std::optional(step.motion) : std::nullopt;
    const Belief& belief = tracker.step(motion, observeScene({*step.scan}));
    expectWellFormed(belief);
    ++outcome.steps;
    outcome.confident_steps += belief.verdict == Verdict::localized;
    if (confidentlyWrong(belief, step.world_from_robot)) outcome.wrong_while_confident = true;
  }
  const Belief& belief = tracker.belief();
  outcome.right_at_end =
      belief.verdict == Verdict::localized &&
      isRight(belief.hypotheses.front().pose.mean, drive.back().world_from_robot);
  return outcome;
}
}  // namespace sigloc::test
