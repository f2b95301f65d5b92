// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/landmarks/LandmarkTracker.h"

#include <algorithm>
#include <cmath>

#include "features/LocalMap.h"
#include "tracking/landmarks/FeatureAssociation.h"
#include "tracking/tracks/pose_update.h"
#include "tracking/tracks/travel.h"

namespace sigloc
{
namespace
{
constexpr std::size_t kRecentSteps = 20;  // that a local map holds
constexpr double kStepTravel = 0.1;  // [m] of travel between two steps of a local map
constexpr std::size_t kMinFeatures = 4;  // fewer are too little seen

/// Returns the features of the mapped types. Derived features keep their parents.
std::vector<Feature> ofTypes(const std::vector<Feature>& features, const std::vector<bool>& types)
{
  std::vector<Feature> kept;
  std::vector<std::int32_t> new_index(features.size(), -1);
  for (std::size_t k = 0; k < features.size(); ++k)
  {
    if (!types[typeIndex(features[k].type)]) continue;
    new_index[k] = static_cast<std::int32_t>(kept.size());
    kept.push_back(features[k]);
  }
  for (Feature& feature : kept)
  {
    if (feature.parent >= 0) feature.parent = new_index[static_cast<std::size_t>(feature.parent)];
  }
  return kept;
}
}  // namespace

LandmarkTracker::LandmarkTracker(std::shared_ptr<const SignatureMatcher> matcher,
                                 const TrackerOptions& options)
    : matcher_(std::move(matcher)),
      options_(options),
      spacing_(matcher_->featureVerifier()->map()),
      mapped_types_(kFeatureTypes, false)
{
  for (const Feature& feature : matcher_->map().features())
  {
    mapped_types_[typeIndex(feature.type)] = true;
    if (isSegment(feature.type)) gathers_ = false;
  }
}

bool LandmarkTracker::addScan(TrackSet& set, const std::optional<MotionIncrement>& motion,
                              const ObservedScene& scene)
{
  seen_ = ofTypes(scene.features, mapped_types_);
  const MotionIncrement moved = motion.value_or(MotionIncrement{});
  for (Track& track : set.tracks)
  {
    track.features.correlation.predict(track.hypothesis.pose.mean, moved.mean);
  }
  if (!motion)
    recent_.clear();  // without odometry the poses of the steps to each other are unknown
  const GaussianPose since =
      composeWithMotion({since_recent_.mean, since_recent_.covariance}, moved);
  since_recent_ = {since.mean, since.covariance};
  return !seen_.empty();
}

void LandmarkTracker::remember()
{
  if (!recent_.empty() && travelOf(since_recent_.mean, options_).with_turns < kStepTravel) return;
  recent_.push_back({since_recent_, seen_});
  since_recent_ = {};
  if (recent_.size() > kRecentSteps) recent_.pop_front();
}

void LandmarkTracker::update(TrackSet& set, double travelled, std::uint64_t& next_id)
{
  const FeatureAssociator associator(*matcher_->featureVerifier(), spacing_, seen_, travelled);
  std::vector<Track> updated;
  updated.reserve(set.tracks.size());
  for (const Track& track : set.tracks)
  {
    const auto ways = associator.associate(track.hypothesis.pose, track.features.correlation);
    for (const FeatureAssociation& way : ways)
    {
      Track child = track;
      child.hypothesis.pose = toGaussian(way.pose);
      child.hypothesis.weight *= way.share;
      if (&way != &ways.front()) child.hypothesis.id = next_id++;
      // All ways count with the best one's log-odds, because their shares separate them already.
      child.score = ways.front().log_odds;
      child.features.correlation = way.correlation;
      child.features.correlation.forgetBefore(travelled - kMemory);
      child.features.new_feature_share =
          std::min(1.0, track.features.new_feature_share + way.new_feature_share);
      child.features.paired = way.pairings.size();
      child.features.doubt = std::min(0.0, track.features.doubt + way.log_odds);
      updated.push_back(std::move(child));
    }
  }
  set.tracks = std::move(updated);
  const bool doubted = !set.tracks.empty() && doubts(set.heaviest());
  // The robot may have been kidnapped. Then the earlier steps do not belong to the present one.
  if (doubted && !doubted_) recent_.clear();
  doubted_ = doubted;
}

/// Weighs tracks against each other by what each pairs, and the best one against "somewhere else".
/// The in-map log-odds grow by new features only. Eq. (8.16) to (8.18)
void LandmarkTracker::weigh(TrackSet& set, double travel) const
{
  if (set.tracks.empty() || travel == 0) return;
  const double best = set.bestScore();
  const double between = std::min(1.0, travel / options_.evidence_distance);
  for (Track& track : set.tracks)
  {
    const double deficit = kFeatureTempering * (track.score - best);
    track.hypothesis.weight *= std::exp(between * deficit);
    const double evidence = kFeatureTempering * track.score;
    const double gain = evidence > 0 ? track.features.new_feature_share * evidence
                                     : between * std::max(evidence, -kMaxAgainst);
    track.features.new_feature_share = 0;
    track.confirmed = std::clamp(track.confirmed + gain, kMinInMap, kMaxConfirmed);
  }
  const double lost = std::min(1.0, travel / options_.lost_distance);
  set.scaleOddsOfElsewhere(-lost * kFeatureTempering * best);
}

std::vector<Feature> LandmarkTracker::gathered() const
{
  LocalMap local;
  for (const Step& step : recent_) local.add(step.motion, step.features);
  local.add(since_recent_, seen_);
  return local.features();
}

/// Once the belief is settled, the present step is enough to confirm it.
RelocationResult LandmarkTracker::localize(const std::optional<PoseRegion>& region,
                                           bool settled) const
{
  ObservedScene scene;
  scene.features = settled || !gathers_ || recent_.empty() ? seen_ : gathered();
  return matcher_->localize(scene, region);
}

bool LandmarkTracker::relocate(TrackSet& set, RelocationSchedule& schedule,
                               const std::optional<PoseRegion>& region, bool settled,
                               std::uint64_t& next_id)
{
  const RelocationResult result = localize(region, settled);
  const double fresh_share = schedule.freshShare();
  if (!schedule.noteResult(result)) return false;
  // "All clutter" has the log-odds 0. Eq. (8.19)
  const auto best = set.bestCandidates(result, &Candidate::score, 0);
  set.weighUntracked(result, kFeatureTempering * (best.untracked - best.tracked), fresh_share);
  for (const Candidate& candidate : result.candidates)
  {
    // A track that has slipped off pairs hardly anything any more, so it moves to the candidate.
    Track* const slipped = set.trackAt(candidate.pose.mean);
    if (slipped == nullptr || slipped->score > 0 || candidate.score <= 0) continue;
    const Track there = startAt(candidate, slipped->hypothesis.id);
    slipped->hypothesis.pose = there.hypothesis.pose;
    slipped->features = there.features;
  }
  const auto new_track = [&](std::size_t k) { return startAt(result.candidates[k], next_id++); };
  set.shareOutElsewhere(result, new_track);
  weighNewTracksAgainstOlder(set);
  return true;
}

/// A new track has explained the gathered features already. So has the heaviest older one, and what
/// came before. The new one may weigh as much where its log-odds are no lower, unless the older one
/// is retained: look-alikes explain a part of the way as well. Eq. (8.24)
void LandmarkTracker::weighNewTracksAgainstOlder(TrackSet& set) const
{
  const Track* heaviest = nullptr;
  for (const Track& track : set.tracks)
  {
    if (track.isNew()) continue;
    if (heaviest == nullptr || track.hypothesis.weight > heaviest->hypothesis.weight)
    {
      heaviest = &track;
    }
  }
  if (heaviest == nullptr || heaviest->retained(sureLogOdds(options_))) return;
  const double weight = heaviest->hypothesis.weight;
  const double log_odds = heaviest->confirmed;
  for (Track& track : set.tracks)
  {
    if (!track.isNew()) continue;
    const double lead = std::min(0.0, track.confirmed - log_odds);
    track.hypothesis.weight = std::max(track.hypothesis.weight, weight * std::exp(lead));
  }
  set.normaliseTracks();
}

/// Returns a new track at a candidate. The features share the errors of the odometry that gathered
/// them, and the pose shares those of the mapped features. So the covariance is widened and the
/// next steps decide.
Track LandmarkTracker::startAt(const Candidate& candidate, std::uint64_t id) const
{
  Track track;
  track.hypothesis.pose = candidate.pose;
  track.hypothesis.pose.covariance *= kSharedErrors;
  track.hypothesis.id = id;
  track.score = candidate.score;
  track.confirmed = std::clamp(kFeatureTempering * candidate.score, kMinInMap, kMaxConfirmed);
  track.features.paired = candidate.pairings.size();
  return track;
}

bool LandmarkTracker::doubts(const Track& track)
{
  return track.features.doubt < -kMaxAgainst;
}

bool LandmarkTracker::seesEnoughToTell() const
{
  return seen_.size() >= kMinFeatures;
}

double LandmarkTracker::reliabilityOf(const Track& track) const
{
  return seen_.empty() ? 0
                       : std::min(1.0, static_cast<double>(track.features.paired) /
                                           static_cast<double>(seen_.size()));
}
}  // namespace sigloc
