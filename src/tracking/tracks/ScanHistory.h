// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "matching/dense/DenseVerifier.h"
#include "sigloc/geometry/GaussianPose.h"
#include "tracking/evidence/ObservedCells.h"
#include "tracking/tracks/TrackSet.h"

namespace sigloc
{
/// What was seen on the way, to ask of a place that is found late how it would have explained it.
/// A relocation lists few places: where many addScan alike, the right one may be missing at first.
class ScanHistory
{
 public:
  explicit ScanHistory(const TrackerOptions& options) : options_(options) {}

  /// Goes on by one step; without odometry the way before it is lost, and everything is forgotten.
  void move(const std::optional<MotionIncrement>& motion);

  /// Remembers a scan, taken after `travelled` [m] in all, unless the last one was taken near by;
  /// of too many the oldest is forgotten.
  void remember(const DenseScan& scan, double travelled);

  /// Gives the tracks that started with this step the weight they would have if they had been
  /// tracked_log_odds as long as the heaviest of the others, at most its own. One that shares its
  /// way up to a slip takes over what is known of it. `scan` is the last one, after `travelled` [m]
  /// in all. \cite algorithm eq. (8.24)
  void weighNewcomers(TrackSet& set, const DenseScan& scan, const DenseVerifier& verifier,
                      double travelled) const;

 private:
  struct Look
  {
    DenseScan scan;
    ObservedCells view;
    mrpt::math::TPose2D odometry;  // where the robot stood, by odometry alone
    double travelled;  // [m]
    std::uint64_t step;
  };
  /// How a robot that came by would have explained a addScan.
  struct Visit
  {
    mrpt::math::TPose2D pose;
    double log_likelihood;  // of its score
    double unexplained;  // cells of the ground more than at the addScan that came later
    double detour;  // log-odds against the step from there
    std::vector<float> explained;  // each return's share
  };
  class Replay;
  /// What the way says of a newcomer.
  struct WaySays
  {
    LogLikelihoodDeficit sum;  // against the heaviest track
    bool branched = false;  // the two ways are one before a slip
    CellEvidence explained;  // what it would remember, but of the last scan; not if branched
  };

  std::vector<Visit> wayTo(const mrpt::math::TPose2D& pose, std::uint64_t since,
                           const DenseVerifier& verifier) const;
  std::optional<WaySays> compareWith(const std::vector<Visit>& rival,
                                     const mrpt::math::TPose2D& pose, double cost_of_unexplained,
                                     const DenseVerifier& verifier) const;
  CellEvidence rememberedOf(const std::vector<Visit>& way) const;
  const Look& lookBack(std::size_t k) const { return looks_[looks_.size() - 1 - k]; }

  TrackerOptions options_;
  std::deque<Look> looks_;
  mrpt::math::TPose2D odometry_;
  std::uint64_t step_ = 0;
  std::uint64_t known_since_ = 0;  // step since when nothing is forgotten
};
}  // namespace sigloc
