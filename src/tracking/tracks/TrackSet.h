// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "matching/dense/DenseVerifier.h"
#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/tracking/TrackerOptions.h"
#include "tracking/evidence/ObservedCells.h"
#include "tracking/tracks/Track.h"

namespace sigloc
{
/// How much of what a scan's score says counts between rivals, in [0, 1], after `travel` [m] since
/// the one before. Few returns tell little: half of a score may hang on three specks. Eq. (8.5)
double shareBetweenRivals(const DenseScan& scan, double travel, const TrackerOptions& options);

/// True for poses so near to each other that their tracks are merged.
bool wouldMerge(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b);

/// The hypotheses that are tracked_log_odds and the weight of "somewhere else"; all weights sum to
/// one. Each method is one step of \cite algorithm section 8.
class TrackSet
{
 public:
  explicit TrackSet(const TrackerOptions& options) : options_(options) {}

  /// Moves every track by the odometry; returns the travel [m], turns included. Eq. (8.1), (8.2)
  double predict(const std::optional<MotionIncrement>& motion);

  /// Refines every track by the returns and scores it; every scan comes here first. Eq. (8.3),
  /// (8.4)
  void update(const DenseScan& scan, const DenseVerifier& verifier);

  /// Weighs rivals against each other, the best against "somewhere else", by a scan after
  /// `travelled` [m] in all, `travel` [m] since the one before. Notes how far the robot sees
  /// and, where there are tracks, how much the best one explains. Eq. (8.5), (8.6), (8.26), (8.29)
  void weigh(const DenseScan& scan, const DenseVerifier& verifier, double travelled, double travel);

  /// Lets a track that starts with the last scan addScan at it, which is no news to it any more.
  void showTo(Track& track, const DenseScan& scan, const DenseVerifier& verifier,
              double travelled) const;

  /// Lets the ground, too, weigh those against each other that the last relocation has started; it
  /// told them apart by their scores. Eq. (8.27)
  void weighFirstLook();

  /// Log-odds that a cell of the ground left unexplained costs against a rival that explains it.
  /// Eq. (8.26)
  double costOfUnexplained() const;

  /// Adds to every track what the parts of the scan tell that came into view with the last `travel`
  /// [m] of `travelled`, on which the robot moved by `driven` [m]. Eq. (8.21), (8.25)
  void follow(const DenseScan& scan, double travelled, double travel, double driven);

  /// Scales all weights so that they sum to one.
  void normalise();

  /// Scales those of the tracks alone, which must not all be zero, and leaves "somewhere else".
  void normaliseTracks();

  /// Tells the tracks which of them a relocation has found best of the whole map.
  void countFound(const RelocationResult& result);

  /// Moves the weight of "somewhere else" by what a relocation that is `fresh_share` news says for
  /// the tracks, `here` in log-odds, while none is held that the relocation's best place without a
  /// track beats by far (`beaten`). Eq. (8.8)
  void weighElsewhere(const RelocationResult& result, double here, bool beaten, double fresh_share);

  /// Deals the lost share of the belief out as a relocation says: to the tracks at its candidates,
  /// to new ones that `start` makes of candidate k, and back to "somewhere else". Eq. (8.9)
  void dealOut(const RelocationResult& result, const std::function<Track(std::size_t k)>& start);

  /// Joins tracks that have met, gives up the light ones, sorts by weight. Eq. (8.10)
  void mergeAndPrune();

  /// The track that holds a pose, or null.
  Track* trackAt(const mrpt::math::TPose2D& pose);

  /// What a claim of the first track depends on besides it, while tracks are sorted.
  ClaimContext circumstances() const
  {
    return {tracks.size() > 1 ? tracks[1].hypothesis.weight : 0.0, range_, unexplained_};
  }

  /// What that claim stands on, while tracks are sorted. Must not be called on an empty set.
  double claimLogOdds() const { return tracks.front().claimLogOdds(circumstances()); }

  /// The heaviest track. Must not be called on an empty set.
  const Track& heaviest() const;

  std::vector<Track> tracks;
  double elsewhere = 1;

 private:
  void weighRivals(const DenseScan& scan, const DenseVerifier& verifier, double travelled,
                   double travel, double best_score);

  TrackerOptions options_;
  bool has_odometry_ = true;  // of the last prediction
  // The robot's pose by odometry alone; without odometry, by the heaviest track.
  mrpt::math::TPose2D ground_;
  mrpt::math::TPose2D left_;  // the heaviest track's before the last prediction
  ObservedCells view_;  // of the last scan, from there
  double unexplained_ = 0;  // share that the best track has left unexplained, lately
  double range_ = 0;  // [m] median of the scans, lately
};
}  // namespace sigloc
