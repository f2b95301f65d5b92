// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/TrackSet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/same_place.h"
#include "matching/candidate_probabilities.h"
#include "tracking/tracks/pose_update.h"
#include "tracking/tracks/travel.h"

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
constexpr double kMergeDistance = 0.3;  // [m] within which tracks are merged, eq. (8.10)
constexpr double kMergeAngle = 10.0 * M_PI / 180.0;  // [rad] within which tracks are merged
constexpr double kLeastChange = 0.02;  // share that has changed even in a new map, eq. (8.26)
constexpr double kMostChange = 0.3;  // largest share that is taken to have changed, eq. (8.26)
constexpr double kCellIndependence = 0.7;  // neighbouring cells share their evidence, eq. (8.26)
constexpr double kMinSigma = 0.005;  // [m] added to the motion of a step, eq. (8.1)

bool heavier(const Track& a, const Track& b)
{
  if (a.hypothesis.weight != b.hypothesis.weight) return a.hypothesis.weight > b.hypothesis.weight;
  return a.hypothesis.id < b.hypothesis.id;
}

/// Returns the weight of a scan in a mean over the last kMemory, `travel` [m] after the one before.
double weightInMean(double travel)
{
  return 1.0 - std::exp(-travel / kMemory);
}
}  // namespace

double shareBetweenRivals(double travel, const TrackerOptions& options)
{
  constexpr double kRivalDistance = 0.7;  // share of evidence_distance
  return std::min(1.0, travel / (kRivalDistance * options.evidence_distance));
}

double sureLogOdds(const TrackerOptions& options)
{
  const double sure = options.localized_probability;
  return std::log(sure / (1.0 - sure));
}

bool wouldMerge(const TPose2D& a, const TPose2D& b)
{
  return withinReach(a, b, kMergeDistance, kMergeAngle);
}

Travel TrackSet::predict(const std::optional<MotionIncrement>& motion)
{
  MotionIncrement increment;
  has_odometry_ = motion.has_value();
  if (motion)
  {
    increment = *motion;
    increment.covariance(0, 0) += kMinSigma * kMinSigma;
    increment.covariance(1, 1) += kMinSigma * kMinSigma;
    increment.covariance(2, 2) += kMinTurnSigma * kMinTurnSigma;
    ground_ = ground_ + motion->mean;
  }
  else
  {
    increment.covariance(0, 0) = options_.free_motion_sigma * options_.free_motion_sigma;
    increment.covariance(1, 1) = increment.covariance(0, 0);
    increment.covariance(2, 2) = options_.free_turn_sigma * options_.free_turn_sigma;
  }
  const Travel travel = motion ? meter_.moveTo(ground_, options_)
                               : Travel{options_.lost_distance, options_.lost_distance};
  for (Track& track : tracks)
  {
    // A robot drives on more steadily than it turns.
    if (!motion) increment.mean = {track.moved.x, track.moved.y, 0};
    track.moved = {};
    track.left = track.hypothesis.pose.mean;
    track.hypothesis.pose = composeWithMotion(track.hypothesis.pose, increment);
    ++track.hypothesis.age;
    track.found = false;
  }
  last_ = travel;
  // What no odometry tells does not wait: the robot may have stood still.
  if (motion) waiting_ += travel.with_turns;
  return travel;
}

Travel TrackSet::travelToScan(bool doubted)
{
  const Travel travel = has_odometry_ ? Travel{last_.distance, waiting_} : last_;
  waiting_ = 0;
  if (tracks.empty()) return travel;
  const TrackedHypothesis& first = heaviest().hypothesis;
  const bool shown = !has_odometry_ && !doubted && heaviest().score >= 0;
  if (!shown && !has_odometry_) return travel;
  if (shown && first.id == seen_id_) return seen_.moveTo(first.pose.mean, options_);
  seen_id_ = first.id;
  seen_.startAt(first.pose.mean);
  return shown ? Travel{} : travel;
}

void TrackSet::refineAndScore(const DenseScan& scan, const DenseVerifier& verifier)
{
  for (Track& track : tracks) updatePose(track, scan, verifier, has_odometry_, options_);
  noteObservedCells(scan);
}

void TrackSet::scoreInPlace(const DenseScan& scan, const DenseVerifier& verifier)
{
  for (Track& track : tracks)
  {
    const TPose2D& pose = track.hypothesis.pose.mean;
    track.evaluated_at = verifier.refine(scan, pose, kUpdateSteps, scan.size());
    track.evidence = verifier.evaluate(scan, track.evaluated_at);
    track.through = track.evidence.through;
    track.score = track.evidence.score;
  }
  noteObservedCells(scan);
}

/// Notes which cells the scan shows, and how far each track has moved. Without odometry the
/// heaviest track tells how the robot moved.
void TrackSet::noteObservedCells(const DenseScan& scan)
{
  for (Track& track : tracks) track.moved = track.hypothesis.pose.mean - track.left;
  if (!has_odometry_ && !tracks.empty())
  {
    ground_ = ground_ + heaviest().moved;
    meter_.startAt(ground_);  // this way is counted as the scans show it
  }
  view_ = observedCells(scan, ground_);
}

void TrackSet::addWayEvidence(const DenseScan& scan, double travelled, double driven)
{
  for (Track& track : tracks)
  {
    const double novelty =
        track.seen_while_tracked.add(scan, track.hypothesis.pose.mean, travelled);
    track.addTrackedLogOdds(novelty * trackedLogOdds(track.evidence));
    track.tracked_distance += driven;
  }
}

void TrackSet::updateUnexplainedShare(double travel)
{
  if (tracks.empty()) return;
  unexplained_ += weightInMean(travel) * (std::max(0.0, 1.0 - bestScore()) - unexplained_);
}

double TrackSet::bestScore() const
{
  return std::max_element(tracks.begin(), tracks.end(),
                          [](const Track& a, const Track& b) { return a.score < b.score; })
      ->score;
}

/// The errors of map and scan stay the same for a stretch, and so do changes since the area was
/// mapped. So scores count per distance, and each observed cell counts once. Eq. (8.5)
void TrackSet::weighRivals(const DenseScan& scan, const DenseVerifier& verifier, double travelled,
                           double travel)
{
  if (tracks.empty()) return;
  updateUnexplainedShare(travel);
  const std::vector<double> unexplained = addToCellEvidence(scan, verifier, travelled);
  const double least = *std::min_element(unexplained.begin(), unexplained.end());
  const double best = logLikelihoodOfScore(bestScore());
  const double share = shareBetweenRivals(travel, options_);
  for (std::size_t k = 0; k < tracks.size(); ++k)
  {
    LogLikelihoodDeficit& deficit = tracks[k].deficit;
    const double before = deficit.smaller();
    const double lead = logLikelihoodOfScore(tracks[k].score) - best;
    deficit.by_score += share * lead;
    deficit.by_cells -= costOfUnexplained() * (unexplained[k] - least);
    tracks[k].hypothesis.weight *= std::exp(deficit.smaller() - before);
  }
  normalise();
}

std::vector<double> TrackSet::addToCellEvidence(const DenseScan& scan,
                                                const DenseVerifier& verifier, double travelled)
{
  std::vector<double> unexplained;
  for (Track& track : tracks)
  {
    const auto explained = verifier.explainedReturns(scan, track.evaluated_at, track.through);
    unexplained.push_back(track.explained.addScan(view_, explained, travelled));
  }
  return unexplained;
}

void TrackSet::addToCellEvidence(Track& track, const DenseScan& scan, const DenseVerifier& verifier,
                                 double travelled) const
{
  const TPose2D& pose = track.hypothesis.pose.mean;
  const auto explained =
      verifier.explainedReturns(scan, pose, verifier.beamsThroughWalls(scan, pose));
  track.explained.addScan(view_, explained, travelled);
}

void TrackSet::weighNewTracksAmongThemselves()
{
  double dealt = 0;
  double most = 0;
  double least = std::numeric_limits<double>::infinity();
  double best_score = 0;
  for (const Track& track : tracks)
  {
    if (!track.isNew()) continue;
    dealt += track.hypothesis.weight;
    most = std::max(most, track.hypothesis.weight);
    least = std::min(least, track.explained.unexplained());
    best_score = std::max(best_score, track.score);
  }
  if (most <= 0) return;
  // At the start, or after all tracks were lost, no earlier scan has shown what has changed.
  const bool all_new = std::all_of(tracks.begin(), tracks.end(), std::mem_fn(&Track::isNew));
  if (all_new) unexplained_ = std::max(0.0, 1.0 - best_score);
  double sum = 0;
  for (Track& track : tracks)
  {
    if (!track.isNew()) continue;
    track.deficit.by_score = std::log(track.hypothesis.weight / most);
    track.deficit.by_cells = -costOfUnexplained() * (track.explained.unexplained() - least);
    track.hypothesis.weight = std::exp(track.deficit.smaller());
    sum += track.hypothesis.weight;
  }
  for (Track& track : tracks)
  {
    if (track.isNew()) track.hypothesis.weight *= dealt / sum;
  }
}

/// Where even the best track leaves much unexplained, the area has changed since it was mapped.
/// Then the right pose fails now and then too, and an unexplained cell costs less. Eq. (8.26)
double TrackSet::costOfUnexplained() const
{
  const double changed = std::min(kMostChange, kLeastChange + unexplained_);
  return kCellIndependence * std::log((1.0 - changed) / changed);
}

void TrackSet::normalise()
{
  double sum = elsewhere;
  for (const Track& track : tracks) sum += track.hypothesis.weight;
  for (Track& track : tracks) track.hypothesis.weight /= sum;
  elsewhere /= sum;
}

void TrackSet::scaleOddsOfElsewhere(double log_odds)
{
  // Only the loser's weight changes: a gain of e^log_odds may be more than a double holds.
  elsewhere *= std::exp(std::min(0.0, log_odds));
  for (Track& track : tracks) track.hypothesis.weight *= std::exp(std::min(0.0, -log_odds));
  normalise();
}

void TrackSet::normaliseTracks()
{
  double sum = 0;
  for (const Track& track : tracks) sum += track.hypothesis.weight;
  for (Track& track : tracks) track.hypothesis.weight *= (1.0 - elsewhere) / sum;
}

const Track* TrackSet::trackAt(const TPose2D& pose) const
{
  for (const Track& track : tracks)
  {
    if (samePlace(track.hypothesis.pose.mean, pose)) return &track;
  }
  return nullptr;
}

Track* TrackSet::trackAt(const TPose2D& pose)
{
  return const_cast<Track*>(std::as_const(*this).trackAt(pose));
}

void TrackSet::sort()
{
  std::sort(tracks.begin(), tracks.end(), heavier);
}

/// A robot that was carried away may stand for long, with jitter in its odometry that adds up. Its
/// scans there do not tell how well the old place is usually explained. So none counts in doubt.
void TrackSet::updateMeanScores(double travel)
{
  const Track* const doubted = isDoubtful() ? &heaviest() : nullptr;
  for (Track& track : tracks)
  {
    if (&track == doubted) continue;
    track.mean_score += weightInMean(travel) * (track.score - track.mean_score);
  }
}

void TrackSet::mergeAndPrune()
{
  sort();
  std::vector<Track> kept;
  for (Track& track : tracks)
  {
    const auto same = std::find_if(
        kept.begin(), kept.end(),
        [&](const Track& other)
        { return wouldMerge(other.hypothesis.pose.mean, track.hypothesis.pose.mean); });
    if (same != kept.end())
    {
      same->absorb(track);
    }
    else if (kept.size() < options_.max_hypotheses &&
             track.hypothesis.weight >= options_.prune_weight)
    {
      kept.push_back(std::move(track));
    }
  }
  tracks = std::move(kept);
  sort();
  giveRestToElsewhere();
}

/// The weight of pruned tracks goes to "somewhere else", which keeps its floor.
void TrackSet::giveRestToElsewhere()
{
  double here = 0;
  for (const Track& track : tracks) here += track.hypothesis.weight;
  const double keep = std::min(here, 1.0 - options_.min_elsewhere);
  for (Track& track : tracks) track.hypothesis.weight *= here > 0 ? keep / here : 0;
  elsewhere = 1.0 - (here > 0 ? keep : 0);
}

double TrackSet::probabilityHere() const
{
  return 1.0 / (1.0 + std::exp(-tracks.front().inMapLogOdds()));
}

bool TrackSet::isConfirmed() const
{
  return tracks.front().inMapLogOdds() >= sureLogOdds(options_);
}

bool TrackSet::isSuspicious() const
{
  return !tracks.empty() && heaviest().hasFallenTo(heaviest().score, options_.score_drop);
}

bool TrackSet::isDoubtful() const
{
  if (!isSuspicious() || heaviest().found) return false;
  const Track& first = heaviest();
  // Without odometry nothing but the scan says that the robot is still there.
  return !has_odometry_ || first.hasFallenTo(scoreOfUnhidden(first.evidence), options_.score_drop);
}

const Track& TrackSet::heaviest() const
{
  return *std::min_element(tracks.begin(), tracks.end(), heavier);
}
}  // namespace sigloc
