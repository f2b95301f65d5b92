// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/pose_update.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "geometry/pose_fusion.h"

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
constexpr double kLeastFit = 0.2;  // score below which the covariance grows no more

/// Returns the refined pose of a step without odometry. The robot may have turned or driven farther
/// than a refinement reaches: along a corridor, returns may match the wall beside a door frame. So
/// other starts within the prior are tried too. The pose that explains the scan best is taken.
TPose2D searchedPose(const TPose2D& predicted, const DenseScan& scan, const DenseVerifier& verifier,
                     const TrackerOptions& options)
{
  constexpr double kTurn = 15.0 * M_PI / 180.0;  // [rad] between starts, under twice the reach
  constexpr double kDrive = 0.2;  // [m] between starts
  constexpr double kBetter = 0.01;  // lead in score that another start needs
  TPose2D best = verifier.refine(scan, predicted, kUpdateSteps, scan.size());
  double best_score = verifier.evaluate(scan, best).score;
  const auto attempt = [&](double drive, double turn)
  {
    const TPose2D start = predicted + TPose2D(drive, 0, turn);
    const TPose2D pose = verifier.refine(scan, start, kUpdateSteps, scan.size());
    const double score = verifier.evaluate(scan, pose).score;
    if (score <= best_score + kBetter) return;
    best = pose;
    best_score = score;
  };
  const int turns = static_cast<int>(std::lround(3.0 * options.free_turn_sigma / kTurn));
  for (int k = -turns; k <= turns; ++k)
  {
    if (k != 0) attempt(0, k * kTurn);
  }
  const int drives = static_cast<int>(std::lround(2.0 * options.free_motion_sigma / kDrive));
  for (int k = -drives; k <= drives; ++k)
  {
    if (k != 0) attempt(k * kDrive, 0);
  }
  best.phi = mrpt::math::wrapToPi(best.phi);
  return best;
}
}  // namespace

void updatePose(Track& track, const DenseScan& scan, const DenseVerifier& verifier,
                bool has_odometry, const TrackerOptions& options)
{
  constexpr double kClearlyBetter = 0.3;  // lead in score that replaces the prediction
  GaussianPose& pose = track.hypothesis.pose;
  const TPose2D predicted_at = pose.mean;
  DenseEvidence predicted = verifier.evaluateEnds(scan, predicted_at);
  GaussianPose measured;
  measured.mean = has_odometry ? verifier.refine(scan, pose.mean, kUpdateSteps, scan.size())
                               : searchedPose(pose.mean, scan, verifier, options);
  const DenseEvidence found = verifier.evaluate(scan, measured.mean);
  measured.covariance = verifier.testedCovarianceAt(scan, measured.mean);
  // What the map does not explain has moved since, and draws the pose towards its old position.
  // Odometry is better there, where there is any.
  const double fit = has_odometry ? std::max(kLeastFit, found.score) : 1.0;
  measured.covariance *= kSharedErrors / fit;
  const bool agrees = squaredMahalanobisDistance(pose, measured) < kUpdateGate;
  // Often the ends alone show that the prediction is no better.
  if (!agrees || found.score <= predicted.score) verifier.testRays(scan, predicted_at, predicted);
  const bool slipped = !agrees && found.score > predicted.score + kClearlyBetter;
  if (agrees) pose = fusePoses(pose, measured);
  if (slipped) pose = measured;
  const bool at_measured = slipped || (agrees && found.score > predicted.score);
  track.evidence = at_measured ? found : predicted;
  track.evaluated_at = at_measured ? measured.mean : pose.mean;
  track.through = at_measured ? found.through
                  : agrees    ? verifier.beamsThroughWalls(scan, pose.mean)
                              : predicted.through;
  track.score = track.evidence.score;
}
}  // namespace sigloc
