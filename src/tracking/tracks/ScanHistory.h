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
/// Stores scans of the way, to see later how a pose that was found late would have explained them.
/// A relocation lists few poses. Where many look alike, the right one may be missing at first.
/// \cite algorithm eq. (8.24)
class ScanHistory
{
 public:
  explicit ScanHistory(const TrackerOptions& options) : options_(options) {}

  /// Goes on by one step. Without odometry the stored scans cannot be linked to it any more, so all
  /// are forgotten.
  void move(const std::optional<MotionIncrement>& motion);

  /// Stores a scan, taken after `travelled` [m] in all, if the last one was taken 0.5 m of travel
  /// before. Of more than 60 the oldest is forgotten.
  void remember(const DenseScan& scan, double travelled);

  /// Gives the tracks that started with this step the weight that they would have if they had been
  /// tracked as long as the heaviest older track, at most its own. A new track that shares the way
  /// of that one up to a slip takes over its evidence. One that the way refutes gets no weight
  /// while the older track is retained and not suspected. `scan` is the last one, after `travelled`
  /// [m] in all. \cite algorithm eq. (8.24)
  void weighNewTracksAgainstOlder(TrackSet& set, const DenseScan& scan,
                                  const DenseVerifier& verifier, double travelled) const;

 private:
  struct StoredScan
  {
    DenseScan scan;
    ObservedCells view;
    mrpt::math::TPose2D odometry;  // pose of the robot by odometry alone
    double travelled;  // [m] in all
    std::uint64_t step;
  };
  /// How a replayed track explains one stored scan.
  struct Visit
  {
    mrpt::math::TPose2D pose;
    double log_likelihood;  // of its score, eq. (7.1)
    double unexplained;  // growth of the unexplained cells by this scan
    std::vector<ExplainedReturn> explained;  // each return
  };
  class Replay;
  /// How a new track compares with the heaviest older one on the way.
  struct Comparison
  {
    LogLikelihoodDeficit sum;  // of the new track against the older one
    bool branched = false;  // the two ways are one before a slip of the older track
    CellEvidence explained;  // of the new track, without the last scan; empty if branched
  };

  std::vector<Visit> replayFrom(const mrpt::math::TPose2D& pose, std::uint64_t since,
                                const DenseVerifier& verifier) const;
  std::optional<Comparison> compareWith(const std::vector<Visit>& rival,
                                        const mrpt::math::TPose2D& pose, double cost_of_unexplained,
                                        const DenseVerifier& verifier) const;
  bool refutes(const LogLikelihoodDeficit& sum) const;
  CellEvidence rememberedOf(const std::vector<Visit>& way) const;
  const StoredScan& storedScan(std::size_t k) const { return scans_[scans_.size() - 1 - k]; }

  TrackerOptions options_;
  std::deque<StoredScan> scans_;
  mrpt::math::TPose2D odometry_;
  std::uint64_t step_ = 0;
  std::uint64_t known_since_ = 0;  // first step from which on no scan is forgotten
};
}  // namespace sigloc
