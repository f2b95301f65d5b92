// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/TrackSet.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "geometry/pose_fusion.h"
#include "geometry/same_place.h"
#include "matching/candidate_probabilities.h"
#include "tracking/tracks/pose_update.h"
#include "tracking/tracks/travel.h"

namespace sigloc
{
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kMergeDistance = 0.3;  // [m]
constexpr double kMergeAngle = 10.0 * M_PI / 180.0;
constexpr double kScanMemory = 10.0;  // [m] of travel
constexpr double kLeastChange = 0.02;  // share of what is mapped that even a map of today has wrong
constexpr double kMostChange = 0.3;
constexpr double kTellsOfCell = 0.7;  // a cell's own share: those beside it tell much the same
constexpr double kSure = 0.9;  // a relocation that overrules all tracks
constexpr double kMostNews = 4.0;  // views that a metre can bring
constexpr double kScoreMemory = 0.9;  // of the running mean of the score, per step
constexpr double kMinSigma = 0.005;  // [m], floor of a step's motion
constexpr double kMinTurnSigma = 0.002;  // [rad]

double medianRange(const DenseScan& scan)
{
  if (scan.size() == 0) return 0;
  std::vector<float> ranges(scan.size());
  std::transform(scan.x.begin(), scan.x.end(), scan.y.begin(), ranges.begin(),
                 [](float x, float y) { return std::hypot(x, y); });
  const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
  std::nth_element(ranges.begin(), middle, ranges.end());
  return static_cast<double>(*middle);
}

bool heavier(const Track& a, const Track& b)
{
  if (a.hypothesis.weight != b.hypothesis.weight) return a.hypothesis.weight > b.hypothesis.weight;
  return a.hypothesis.id < b.hypothesis.id;
}
}  // namespace

double shareBetweenRivals(const DenseScan& scan, double travel, const TrackerOptions& options)
{
  constexpr double kTelling = 60;  // returns
  constexpr double kBold = 0.7;  // of the distance: another judge must agree
  const auto seen = std::count(scan.isolated.begin(), scan.isolated.end(), 0);
  return std::min(1.0, static_cast<double>(seen) / kTelling) *
         std::min(1.0, travel / (kBold * options.evidence_distance));
}

bool wouldMerge(const TPose2D& a, const TPose2D& b)
{
  return withinReach(a, b, kMergeDistance, kMergeAngle);
}

double TrackSet::predict(const std::optional<MotionIncrement>& motion)
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
    if (!tracks.empty()) left_ = heaviest().hypothesis.pose.mean;
  }
  const double travel = motion ? travelOf(increment.mean, options_) : options_.lost_distance;
  for (Track& track : tracks)
  {
    track.hypothesis.pose = composeWithMotion(track.hypothesis.pose, increment);
    ++track.hypothesis.age;
    track.found = false;
  }
  return travel;
}

void TrackSet::update(const DenseScan& scan, const DenseVerifier& verifier)
{
  for (Track& track : tracks) updatePose(track, scan, verifier, has_odometry_, options_);
  if (!has_odometry_ && !tracks.empty())
  {
    ground_ = ground_ + (heaviest().hypothesis.pose.mean - left_);
  }
  view_ = observedCells(scan, ground_);
}

void TrackSet::follow(const DenseScan& scan, double travelled, double travel, double driven)
{
  // A robot that stands still sees new cells by noise alone.
  const double most = kMostNews * travel;
  for (Track& track : tracks)
  {
    const double novelty =
        std::min(most, track.seen_while_tracked.add(scan, track.hypothesis.pose.mean, travelled));
    track.addTrackedLogOdds(novelty * trackedLogOdds(track.evidence));
    track.addFit(travel);
    track.tracked_distance += driven;
  }
}

/// Against "somewhere else" the best track is weighed by its score alone, and at once; one that is
/// held is not given up for what ends before mapped walls, because something may hide them.
void TrackSet::weigh(const DenseScan& scan, const DenseVerifier& verifier, double travelled,
                     double travel)
{
  const double fresh = 1.0 - std::exp(-travel / kScanMemory);
  range_ += (range_ > 0 ? fresh : 1.0) * (medianRange(scan) - range_);
  if (tracks.empty()) return;
  const double best_score =
      std::max_element(tracks.begin(), tracks.end(),
                       [](const Track& a, const Track& b) { return a.score < b.score; })
          ->score;
  unexplained_ += fresh * (std::max(0.0, 1.0 - best_score) - unexplained_);
  weighRivals(scan, verifier, travelled, travel, best_score);
  const double lost = std::min(1.0, travel / options_.lost_distance);
  double most = -1;
  for (const Track& track : tracks)
  {
    most = std::max(most, track.retained() ? scoreOfUnhidden(track.evidence) : track.score);
  }
  const double for_lost = std::clamp(
      logLikelihoodOfScore(options_.lost_score) - logLikelihoodOfScore(most), -kMaxLost, kMaxLost);
  elsewhere *= std::exp(lost * for_lost);
  normalise();
}

/// The errors of map and scan stay the same for a stretch, and so does what has changed since the
/// place was mapped: scores count per distance, and each piece of the ground but once.
void TrackSet::weighRivals(const DenseScan& scan, const DenseVerifier& verifier, double travelled,
                           double travel, double best_score)
{
  std::vector<double> unexplained;
  for (Track& track : tracks)
  {
    const auto explained = verifier.explainedReturns(scan, track.evaluated_at);
    unexplained.push_back(track.explained.addScan(view_, explained, travelled));
  }
  const double least = *std::min_element(unexplained.begin(), unexplained.end());
  const double best = logLikelihoodOfScore(best_score);
  const double share = shareBetweenRivals(scan, travel, options_);
  for (std::size_t k = 0; k < tracks.size(); ++k)
  {
    LogLikelihoodDeficit& deficit = tracks[k].deficit;
    const double before = deficit.smaller();
    const double lead = logLikelihoodOfScore(tracks[k].score) - best;
    deficit.by_score += share * std::max(lead, -kMaxRelative);
    deficit.by_cells -= std::min(kMaxRelative, costOfUnexplained() * (unexplained[k] - least));
    tracks[k].hypothesis.weight *= std::exp(deficit.smaller() - before);
  }
}

void TrackSet::showTo(Track& track, const DenseScan& scan, const DenseVerifier& verifier,
                      double travelled) const
{
  const auto explained = verifier.explainedReturns(scan, track.hypothesis.pose.mean);
  track.explained.addScan(view_, explained, travelled);
}

void TrackSet::weighFirstLook()
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
  // Waking up, or after all was lost: what has changed is not known from earlier looks.
  const bool all_new = std::all_of(tracks.begin(), tracks.end(), std::mem_fn(&Track::isNew));
  if (all_new) unexplained_ = std::max(0.0, 1.0 - best_score);
  double told = 0;
  for (Track& track : tracks)
  {
    if (!track.isNew()) continue;
    track.deficit.by_score = std::log(track.hypothesis.weight / most);
    track.deficit.by_cells = -costOfUnexplained() * (track.explained.unexplained() - least);
    track.hypothesis.weight = std::exp(track.deficit.smaller());
    told += track.hypothesis.weight;
  }
  for (Track& track : tracks)
  {
    if (track.isNew()) track.hypothesis.weight *= dealt / told;
  }
}

/// Where the best of all has been leaving things unexplained, the place has changed since it was
/// mapped, and the right pose must be expected to fail now and then.
double TrackSet::costOfUnexplained() const
{
  const double changed = std::min(kMostChange, kLeastChange + unexplained_);
  return kTellsOfCell * std::log((1.0 - changed) / changed);
}

void TrackSet::normalise()
{
  double sum = elsewhere;
  for (const Track& track : tracks) sum += track.hypothesis.weight;
  for (Track& track : tracks) track.hypothesis.weight /= sum;
  elsewhere /= sum;
}

void TrackSet::normaliseTracks()
{
  double sum = 0;
  for (const Track& track : tracks) sum += track.hypothesis.weight;
  for (Track& track : tracks) track.hypothesis.weight *= (1.0 - elsewhere) / sum;
}

Track* TrackSet::trackAt(const TPose2D& pose)
{
  for (Track& track : tracks)
  {
    if (samePlace(track.hypothesis.pose.mean, pose)) return &track;
  }
  return nullptr;
}

void TrackSet::countFound(const RelocationResult& result)
{
  const Track* best =
      result.candidates.empty() ? nullptr : trackAt(result.candidates.front().pose.mean);
  for (Track& track : tracks) track.noteRelocation(&track == best);
}

void TrackSet::weighElsewhere(const RelocationResult& result, double here, bool beaten,
                              double fresh_share)
{
  const bool firm = !beaten && std::any_of(tracks.begin(), tracks.end(),
                                           [](const Track& track) { return track.retained(); });
  const double told = std::clamp(here, firm ? 0.0 : -kMaxLost, kMaxLost);
  elsewhere *= std::exp(-fresh_share * told);
  const bool overruled = !firm && !result.candidates.empty() &&
                         result.candidates.front().probability >= kSure &&
                         trackAt(result.candidates.front().pose.mean) == nullptr;
  if (overruled) elsewhere = std::max(elsewhere, options_.suspicion);
  normalise();
}

/// What is only the floor of "somewhere else" starts tracks but feeds none: else addScan-alikes
/// would draw on it at every relocation.
void TrackSet::dealOut(const RelocationResult& result,
                       const std::function<Track(std::size_t k)>& start)
{
  const double lost = elsewhere;
  const double above_floor = std::max(0.0, lost - options_.min_elsewhere);
  for (std::size_t k = 0; k < result.candidates.size(); ++k)
  {
    const Candidate& candidate = result.candidates[k];
    Track* same = trackAt(candidate.pose.mean);
    const double share = (same != nullptr ? above_floor : lost) * candidate.probability;
    elsewhere -= share;
    if (same == nullptr)
    {
      tracks.push_back(start(k));
      same = &tracks.back();
    }
    same->hypothesis.weight += share;
  }
}

void TrackSet::mergeAndPrune()
{
  std::sort(tracks.begin(), tracks.end(), heavier);
  std::vector<Track> kept;
  for (Track& track : tracks)
  {
    const auto same = std::find_if(
        kept.begin(), kept.end(),
        [&](const Track& other)
        { return wouldMerge(other.hypothesis.pose.mean, track.hypothesis.pose.mean); });
    if (same != kept.end())
    {
      TrackedHypothesis& into = same->hypothesis;
      into.pose =
          mergeByMoments(into.pose, into.weight, track.hypothesis.pose, track.hypothesis.weight);
      into.weight += track.hypothesis.weight;
      into.id = std::min(into.id, track.hypothesis.id);
      same->confirmed = std::max(same->confirmed, track.confirmed);
      same->tracked_log_odds = std::max(same->tracked_log_odds, track.tracked_log_odds);
      same->tracked_distance = std::max(same->tracked_distance, track.tracked_distance);
      into.age = std::max(into.age, track.hypothesis.age);
      same->found = same->found || track.found;
    }
    else if (kept.size() < options_.max_hypotheses &&
             track.hypothesis.weight >= options_.prune_weight)
    {
      kept.push_back(std::move(track));
    }
  }
  tracks = std::move(kept);
  std::sort(tracks.begin(), tracks.end(), heavier);
  double here = 0;
  for (Track& track : tracks)
  {
    here += track.hypothesis.weight;
    track.mean_score = kScoreMemory * track.mean_score + (1 - kScoreMemory) * track.score;
  }
  // What was given up went elsewhere, and elsewhere keeps its floor.
  const double keep = std::min(here, 1.0 - options_.min_elsewhere);
  for (Track& track : tracks) track.hypothesis.weight *= here > 0 ? keep / here : 0;
  elsewhere = 1.0 - (here > 0 ? keep : 0);
}

const Track& TrackSet::heaviest() const
{
  return *std::min_element(tracks.begin(), tracks.end(), heavier);
}
}  // namespace sigloc
