// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "SeenStructure.h"
#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/matching/DenseVerifier.h"
#include "sigloc/tracking/Belief.h"
#include "sigloc/tracking/HypothesisTracker.h"
#include "sigloc/tracking/MapCorrelation.h"

namespace sigloc
{
// Bounds of what one relocation or one unit of travel can tell, in log-odds; with a dense field and
// without. Section 8 of docs/algorithm.md gives them where they are used.
constexpr double kMaxRelative = 3.0;  // between rivals
constexpr double kMaxLost = 3.0;  // for "somewhere else"
constexpr double kMaxConfirmed = 12.0;  // what was confirmed long ago can still be lost
constexpr double kMinConfirmed = -1.0;  // what look-alikes hid for long can still be confirmed
constexpr double kMaxAgainst = 2.0;  // against a track, a metre
constexpr double kHeld = 4.0;  // from which on a track is not given up for a look-alike
constexpr double kFarBetter = 4.0;  // by which a place must beat what is held

/// What a track remembers of the mapped features it was paired with.
struct FeatureMemory
{
  MapCorrelation correlation;
  std::size_t paired = 0;  // in the last step
  double fresh_share = 0;  // of them, those that were not seen on the last stretch
  double doubt = 0;  // log-odds lately lost against clutter, at most 0, eq. (8.20)
};

/// A hypothesis with what the tracker remembers of it.
struct Track
{
  TrackedHypothesis hypothesis;
  double score = 0;  // of the last scan
  DenseEvidence evidence;  // of the last scan
  double mean_score = 0;  // running mean
  bool found = false;  // best of the whole map by this step's relocation
  double confirmed = 0;  // log-odds that relocations, each blind to the track, have given it
  SeenStructure seen;  // what that evidence rests on
  double followed = 0;  // log-odds from how the map explained what came into view on the way
  SeenStructure on_the_way;  // what has come into view
  std::optional<double> misfit;  // of what is seen, known or new, lately; none without a field
  double on_walls = 0;  // mean fine likelihood of what is seen in known land, likewise
  double followed_way = 0;  // [m] driven since the track began
  FeatureMemory features;  // in a map without a dense field

  /// Adds to `followed`, within its bounds.
  void addFollowed(double log_odds);

  /// Takes what the map explains of the last scan, and what not, into their means over some travel
  /// [m].
  void addFit(double travel);

  /// Log-odds of standing in the map at all, eq. (8.22)
  double presence() const;

  /// What is added to them for having been followed so far, eq. (8.25); 0 without a field.
  double survival() const;

  /// Whether a relocation or the way has told enough not to give the track up for a look-alike.
  bool held() const { return std::max(confirmed, presence()) >= kHeld; }

  /// Whether the score `now` of the last scan is less by `drop` than the track's scores used to be.
  bool hasFallenTo(double now, double drop) const
  {
    return hypothesis.age > 1 && now < mean_score - drop;
  }
};

/// How much of what a scan says counts between rivals, in [0, 1], after `travel` [m] since the one
/// before, a scan being news after `evidence_distance` [m]. Few returns tell little: half of a
/// score may hang on three specks. Eq. (8.5)
double shareBetweenRivals(const DenseScan& scan, double travel, double evidence_distance);

/// True for a pose so near to a track that it is the track's.
bool isSamePlace(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b);

/// True for poses so near to each other that their tracks are merged.
bool wouldMerge(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b);

/// The hypotheses that are followed and the weight of "somewhere else"; all weights sum to one.
/// Each method is one step of \cite algorithm section 8.
class TrackSet
{
 public:
  explicit TrackSet(const TrackerOptions& options) : options_(options) {}

  /// Moves every track by the odometry; returns the travel [m], turns included. Eq. (8.1), (8.2)
  double predict(const std::optional<MotionIncrement>& motion);

  /// Refines every track by the returns and scores it. Eq. (8.3), (8.4)
  void update(const DenseScan& scan, const DenseVerifier& verifier);

  /// Weighs rivals against each other, the best against "somewhere else". Eq. (8.5), (8.6)
  void weigh(double travel, const DenseScan& scan);

  /// Travel [m] after which another scan speaks for itself between rivals. Eq. (8.26)
  double evidenceDistance() const;

  /// Adds to every track what the parts of the scan tell that came into view with the last `travel`
  /// [m] of `travelled`, on which the robot moved by `driven` [m]. Eq. (8.21), (8.25)
  void follow(const DenseScan& scan, double travelled, double travel, double driven);

  /// Scales all weights so that they sum to one.
  void normalise();

  /// Scales those of the tracks alone, which must not all be zero, and leaves "somewhere else".
  void normaliseTracks();

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

  /// The heaviest track. Must not be called on an empty set.
  const Track& heaviest() const;

  std::vector<Track> tracks;
  double elsewhere = 1;

 private:
  void updatePose(Track& track, const DenseScan& scan, const DenseVerifier& verifier) const;
  mrpt::math::TPose2D searchedPose(const mrpt::math::TPose2D& predicted, const DenseScan& scan,
                                   const DenseVerifier& verifier) const;

  TrackerOptions options_;
  bool has_odometry_ = true;  // of the last prediction
  double unexplained_ = 0;  // share that the best track has left unexplained, lately
};
}  // namespace sigloc
