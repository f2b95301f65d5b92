// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "matching/dense/DenseVerifier.h"
#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/tracking/TrackerOptions.h"
#include "tracking/evidence/ObservedCells.h"
#include "tracking/tracks/Track.h"
#include "tracking/tracks/travel.h"

namespace sigloc
{
constexpr std::size_t kUpdateBeams = 180;  // returns that update or score a track
constexpr double kMinTurnSigma = 0.002;  // [rad] added to a turn, eq. (8.1)

/// Returns how far the score of a scan counts between rivals, in [0, 1], `travel` [m] after the
/// scan before. \cite algorithm eq. (8.5)
double shareBetweenRivals(double travel, const TrackerOptions& options);

/// Returns the log-odds from which a probability is high enough for a claim. They also tell which
/// track is retained, and by how much a pose must lead to overrule it. \cite algorithm section 8
double sureLogOdds(const TrackerOptions& options);

/// True for poses so near to each other that their tracks are merged. Eq. (8.10)
bool wouldMerge(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b);

/// The tracked hypotheses and the weight of "somewhere else". All weights sum to one. Each method
/// is one part of a step of \cite algorithm section 8.
class TrackSet
{
 public:
  explicit TrackSet(const TrackerOptions& options) : options_(options) {}

  /// Moves every track by the odometry, and without one on as in its last step. Returns the travel
  /// by odometry, `lost_distance` without one. Eq. (8.1), (8.2)
  Travel predict(const std::optional<MotionIncrement>& motion);

  /// Returns the travel to the last scan from the one before that was asked for. Its distance is
  /// that of the last step alone: a way on which nothing is seen is not followed. Without odometry
  /// only the scans show it: while the heaviest track stays where it is and scores at least 0,
  /// another scan is no new evidence. Where it explains the scans no more, or is `doubted`, the
  /// travel of predict() counts. Must be called once for every scan that sees enough, after the
  /// tracks are scored. Eq. (8.2)
  Travel travelToScan(bool doubted);

  /// Refines every track by the returns and scores it. Must be called first for every scan.
  /// Eq. (8.3), (8.4)
  void refineAndScore(const DenseScan& scan, const DenseVerifier& verifier);

  /// Scores every track by the returns, at the pose that a refinement reaches, in the place of
  /// refineAndScore(): something else has set the poses, and they stay.
  void scoreInPlace(const DenseScan& scan, const DenseVerifier& verifier);

  /// Weighs tracks against each other. The scan is taken after `travelled` [m] in all, `travel` [m]
  /// after the one before, more than 0. Includes updateUnexplainedShare(). Eq. (8.5), (8.26)
  void weighRivals(const DenseScan& scan, const DenseVerifier& verifier, double travelled,
                   double travel);

  /// Updates the mean share that the best track leaves unexplained, where there are tracks. Eq.
  /// (8.26)
  void updateUnexplainedShare(double travel);

  /// Adds the scan to the observed cells of every track. Returns by how many cells the unexplained
  /// sum of each has grown. Eq. (8.26)
  std::vector<double> addToCellEvidence(const DenseScan& scan, const DenseVerifier& verifier,
                                        double travelled);

  /// Adds the last scan to the observed cells of a track that starts with it.
  void addToCellEvidence(Track& track, const DenseScan& scan, const DenseVerifier& verifier,
                         double travelled) const;

  /// Weighs the tracks that the last relocation has started against each other by their observed
  /// cells too, where the relocation has used scores alone. Eq. (8.27)
  void weighNewTracksAmongThemselves();

  /// Log-odds that an unexplained cell costs against a rival that explains it. Eq. (8.26)
  double costOfUnexplained() const;

  /// Adds to the log-odds of every track by the part of the scan that came into view with the last
  /// step, after `travelled` [m] in all. The robot has moved by `driven` [m], turns not counted.
  /// Eq. (8.21)
  void addWayEvidence(const DenseScan& scan, double travelled, double driven);

  /// Multiplies the odds of "somewhere else" against the tracks by e^log_odds, and scales all
  /// weights so that they sum to one. Any finite number will do. Eq. (8.17), (8.19), (9.3)
  void scaleOddsOfElsewhere(double log_odds);

  /// Scales the weights of the tracks alone so that all sum to one. They must not all be zero.
  void normaliseTracks();

  /// Marks the track that the relocation has found best of the whole map, and no other.
  void markBestOfMap(const RelocationResult& result);

  /// The best of a relocation's candidates that belong to a track, and of the others.
  struct BestCandidates
  {
    double tracked, untracked;
  };
  /// Returns the largest `measure` of both kinds of candidates, `least` where there is none above.
  BestCandidates bestCandidates(const RelocationResult& result, double Candidate::*measure,
                                double least) const;

  /// Raises the weight of "somewhere else" where a relocation is sure of a pose without a track.
  /// Not where a track is retained, unless that pose leads by enough. `lead` [log-odds] is that of
  /// the best candidate without a track over the best with one, in a dense field over the best
  /// track. Section 8, "Relocate"
  void raiseElsewhereIfOverruled(const RelocationResult& result, double lead);

  /// Weighs "somewhere else" by the same `lead`, which counts by `fresh_share` in [0, 1]. Then
  /// raises it as above. A search that was not complete changes nothing: it may have missed the
  /// poses of the tracks. Eq. (8.19), (9.3)
  void weighUntracked(const RelocationResult& result, double lead, double fresh_share);

  /// Shares the weight of "somewhere else" out by the probabilities of a relocation: to the tracks
  /// at its candidates, and to new ones that `start` makes of candidate k. The rest stays. Eq.
  /// (8.9)
  void shareOutElsewhere(const RelocationResult& result,
                         const std::function<Track(std::size_t k)>& start);

  /// Sorts the tracks by weight, heaviest first.
  void sort();

  /// Merges tracks that have met, prunes the light ones and sorts by weight. Eq. (8.10)
  void mergeAndPrune();

  /// Adds the scores of the last scan, `travel` [m] after the one before, to the tracks' means.
  void updateMeanScores(double travel);

  /// Returns the track at a pose (within 0.5 m and 17 degrees), or null.
  const Track* trackAt(const mrpt::math::TPose2D& pose) const;
  Track* trackAt(const mrpt::math::TPose2D& pose);

  /// Probability that the robot is in the map, by the first track. The tracks must be sorted, and
  /// not empty. Eq. (8.22)
  double probabilityHere() const;

  /// True where the evidence that the robot is in the map is enough for a claim of the first track.
  /// The tracks must be sorted, and not empty. Section 8, "Publish"
  bool isConfirmed() const;

  /// True where the heaviest track suddenly explains much less than before: the robot was kidnapped
  /// or the odometry slipped.
  bool isSuspicious() const;

  /// True where suspicion stops a claim of the heaviest track. It does not where a relocation finds
  /// no better pose in the whole map, nor where less is explained only because something hides the
  /// walls. False for an empty set.
  bool isDoubtful() const;

  const TrackerOptions& options() const { return options_; }

  /// The heaviest track. Must not be called on an empty set.
  const Track& heaviest() const;

  /// The highest score of a track for the last scan. Must not be called on an empty set.
  double bestScore() const;

  std::vector<Track> tracks;
  double elsewhere = 1;

 private:
  void noteObservedCells(const DenseScan& scan);
  void normalise();
  bool mayOverrule(double lead) const;
  void giveRestToElsewhere();

  TrackerOptions options_;
  bool has_odometry_ = true;  // of the last prediction
  // The robot's pose by odometry alone; without odometry, by the heaviest track.
  mrpt::math::TPose2D ground_;
  TravelMeter meter_;  // of ground_, for steps with odometry
  Travel last_;  // of the last prediction
  double waiting_ = 0;  // [m] by odometry, turns included, since the last scan that saw enough
  TravelMeter seen_;  // of the heaviest track, for steps without odometry
  std::uint64_t seen_id_ = 0;  // of that track
  ObservedCells view_;  // of the last scan, from ground_
  double unexplained_ = 0;  // fading mean of the share that the best track leaves unexplained
};
}  // namespace sigloc
