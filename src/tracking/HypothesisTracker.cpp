// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/tracking/HypothesisTracker.h"

#include <algorithm>
#include <stdexcept>

#include "features/feature_values.h"
#include "matching/candidate_probabilities.h"
#include "matching/dense/DenseVerifier.h"
#include "tracking/belief_verdict.h"
#include "tracking/landmarks/LandmarkTracker.h"
#include "tracking/step_input.h"
#include "tracking/tracks/ScanHistory.h"
#include "tracking/tracks/TrackSet.h"
#include "tracking/tracks/travel.h"

namespace sigloc
{
namespace
{
constexpr std::size_t kUpdateBeams = 180;  // returns that update a track
constexpr double kMissWeight = 0.5;  // factor of the evidence against a track, eq. (8.7)
constexpr double kInitialTrackedLogOdds = -6.5;  // of a new track from the way driven, eq. (8.21)

const DenseField* fieldOf(const FeatureMap& map)
{
  return map.field() ? &*map.field() : nullptr;
}
}  // namespace

struct HypothesisTracker::State
{
  State(std::shared_ptr<const SignatureMatcher> m, const TrackerOptions& o)
      : matcher(std::move(m)), options(o), set(o), past(o)
  {
    startAnew();
  }

  void startAnew();
  void trackDensely(const std::optional<MotionIncrement>& motion, const ObservedScene& scene,
                    double travel);
  void trackByFeatures(const std::optional<MotionIncrement>& motion, double travel);
  bool seesTooLittle(const ObservedScene& scene) const;

  void countTravel(double travel);
  void haveRelocated();
  double travelSeen(double assumed);
  double freshShare() const;
  bool suspicious() const;
  bool doubtful() const;
  bool wantsRelocation() const;
  void relocate(const ObservedScene& scene, const DenseScan& scan);
  void confirm(const RelocationResult& result, const DenseScan& scan, double fresh_share);
  bool isBeaten(const RelocationResult& result);
  Track startAt(const RelocationResult& result, std::size_t k, const DenseScan& scan);
  void rateFirst(const DenseScan& scan);
  void publish(const ObservedScene& scene);
  void publishProbabilities();

  std::shared_ptr<const SignatureMatcher> matcher;
  TrackerOptions options;
  std::optional<PoseRegion> region;
  TrackSet set;
  ScanHistory past;
  std::unique_ptr<LandmarkTracker> landmark_tracker;  // null where the map has a dense field
  std::uint64_t next_id = 1;
  double travel_since_relocation = 0;  // [m]
  double travelled = 0;  // [m] in all
  double searched = 0;  // [m] driven since the robot was last localized, or since the start
  bool waking_up = true;  // no relocation has given an answer yet
  bool relocated = false;  // in this step
  double reliability = 0;  // of the first hypothesis at the last scan with enough returns
  std::uint64_t seen_id = 0;  // id of the track that was heaviest when the robot last moved
  mrpt::math::TPose2D seen_pose;  // pose of that track then
  Belief belief;
};

HypothesisTracker::HypothesisTracker(std::shared_ptr<const SignatureMatcher> matcher,
                                     const TrackerOptions& options)
{
  if (!matcher) throw std::invalid_argument("HypothesisTracker: no matcher");
  checkOptions(options);
  state_ = std::make_unique<State>(std::move(matcher), options);
}
HypothesisTracker::~HypothesisTracker() = default;
HypothesisTracker::HypothesisTracker(HypothesisTracker&&) noexcept = default;
HypothesisTracker& HypothesisTracker::operator=(HypothesisTracker&&) noexcept = default;

const Belief& HypothesisTracker::belief() const
{
  return state_->belief;
}
InMapEvidence HypothesisTracker::evidence() const
{
  const std::vector<Track>& tracks = state_->set.tracks;
  return tracks.empty() ? InMapEvidence{} : tracks.front().summary();
}
bool HypothesisTracker::relocated() const
{
  return state_->relocated;
}

void HypothesisTracker::reset(const std::optional<PoseRegion>& region)
{
  state_->region = region;
  state_->startAnew();
}

void HypothesisTracker::State::startAnew()
{
  set = TrackSet(options);
  past = ScanHistory(options);
  waking_up = true;
  searched = 0;
  belief = {};
  if (matcher->featureVerifier() == nullptr) return;
  landmark_tracker = std::make_unique<LandmarkTracker>(matcher, options);
}

const Belief& HypothesisTracker::step(const std::optional<MotionIncrement>& motion,
                                      const ObservedScene& scene)
{
  if (motion) checkMotion(*motion);
  checkScene(scene);
  State& s = *state_;
  s.relocated = false;
  const bool sees_enough = s.landmark_tracker
                               ? s.landmark_tracker->addScan(s.set, motion, scene)
                               : scene.beams.size() >= s.matcher->options().min_beams;
  const double travel = s.set.predict(motion);
  s.past.move(motion);
  if (!sees_enough)
  {
    s.countTravel(travel);
  }
  else if (s.landmark_tracker)
  {
    s.trackByFeatures(motion, travel);
  }
  else
  {
    s.trackDensely(motion, scene, travel);
  }
  s.publish(scene);
  return s.belief;
}

void HypothesisTracker::State::trackDensely(const std::optional<MotionIncrement>& motion,
                                            const ObservedScene& scene, double travel)
{
  const DenseScan scan = makeDenseScan(scene, kUpdateBeams);
  set.update(scan, *matcher->verifier());
  if (!motion) travel = travelSeen(travel);
  countTravel(travel);
  const double driven = motion ? motion->mean.norm() : travel;
  searched += driven;
  past.remember(scan, travelled);
  set.follow(scan, travelled, travel, driven);
  set.weigh(scan, *matcher->verifier(), travelled, travel);
  if (wantsRelocation()) relocate(scene, scan);
  set.mergeAndPrune();
  rateFirst(scan);
}

void HypothesisTracker::State::trackByFeatures(const std::optional<MotionIncrement>& motion,
                                               double travel)
{
  landmark_tracker->update(set, travelled + travel, next_id);
  if (!motion) travel = travelSeen(travel);
  countTravel(travel);
  landmark_tracker->weigh(set, travel);
  if (wantsRelocation())
  {
    const bool settled = belief.verdict == Verdict::localized && !suspicious();
    const bool answered = landmark_tracker->relocate(set, waking_up ? region : std::nullopt,
                                                     freshShare(), settled, next_id);
    if (answered) haveRelocated();
  }
  landmark_tracker->remember();
  set.mergeAndPrune();
  reliability = set.tracks.empty() ? 0 : landmark_tracker->reliabilityOf(set.tracks.front());
}

void HypothesisTracker::State::countTravel(double travel)
{
  travel_since_relocation += travel;
  travelled += travel;
}

void HypothesisTracker::State::haveRelocated()
{
  relocated = true;
  waking_up = false;
  travel_since_relocation = 0;
}

/// How much a relocation counts as new evidence, in [0, 1]: phi of section 8.
double HypothesisTracker::State::freshShare() const
{
  return waking_up ? 1.0 : std::min(1.0, travel_since_relocation / options.evidence_distance);
}

/// Returns the travel [m] of a step without odometry, where only the scans show whether the robot
/// moves. While the heaviest track stays where it is and explains the scans, another scan is no new
/// evidence. Where it explains them no more, the `assumed` travel counts. Eq. (8.2)
double HypothesisTracker::State::travelSeen(double assumed)
{
  constexpr double kMoved = 0.15;  // [m], more than the jitter of the poses of a robot at rest
  if (set.tracks.empty() || suspicious()) return assumed;
  const Track& first = set.heaviest();
  if (first.score < (landmark_tracker ? 0 : options.lost_score)) return assumed;
  const mrpt::math::TPose2D& pose = first.hypothesis.pose.mean;
  const bool same = first.hypothesis.id == seen_id;
  const double moved = travelBetween(seen_pose, pose, options);
  if (same && moved < kMoved) return 0;
  seen_id = first.hypothesis.id;
  seen_pose = pose;
  return same ? moved : 0;
}

/// True where the heaviest track suddenly explains much less than before: the robot was kidnapped
/// or the odometry slipped.
bool HypothesisTracker::State::suspicious() const
{
  if (set.tracks.empty()) return false;
  const Track& first = set.heaviest();
  if (landmark_tracker) return LandmarkTracker::doubts(first);
  return first.hasFallenTo(first.score, options.score_drop);
}

/// True where suspicion stops a claim. It does not where a relocation finds no better pose in the
/// whole map, nor where less is explained only because something hides the walls.
bool HypothesisTracker::State::doubtful() const
{
  const Track& first = set.tracks.front();
  if (landmark_tracker && LandmarkTracker::contradicts(first)) return true;
  if (first.found || !suspicious()) return false;
  return landmark_tracker || first.hasFallenTo(scoreOfUnhidden(first.evidence), options.score_drop);
}

/// True at the start and after a sudden fall of the score. Else relocations come at a steady rate,
/// and at a lower one while the heaviest track has nearly all the weight and is retained.
bool HypothesisTracker::State::wantsRelocation() const
{
  if (waking_up || suspicious()) return true;
  const bool retained = !set.tracks.empty() &&
                        set.heaviest().hypothesis.weight >= options.localized_probability &&
                        set.heaviest().retained();
  return travel_since_relocation >=
         (retained ? options.confirmation_distance : options.relocation_distance);
}

/// A relocation does not depend on the tracks. So it is evidence for a track, may overrule all of
/// them, and starts tracks at poses without one. Eq. (8.7), (8.9)
void HypothesisTracker::State::relocate(const ObservedScene& scene, const DenseScan& scan)
{
  const RelocationResult result = matcher->localize(scene, waking_up ? region : std::nullopt);
  if (result.verdict == Verdict::too_little_seen) return;
  const double fresh_share = freshShare();
  haveRelocated();

  set.noteFound(result);
  confirm(result, scan, fresh_share);
  set.overrule(result, isBeaten(result));
  set.dealOut(result, [&](std::size_t k) { return startAt(result, k, scan); });
  set.weighFirstScan();
  past.weighNewcomers(set, scan, *matcher->verifier(), travelled);
}

/// Adds to the in-map log-odds of the tracks. Evidence for a track counts by the share of structure
/// that is new to the track, because a second scan of a room repeats the likeness of the first.
/// The weights decide between look-alikes; this decides whether the robot is in the map at all.
/// Eq. (8.7)
void HypothesisTracker::State::confirm(const RelocationResult& result, const DenseScan& scan,
                                       double fresh_share)
{
  for (Track& track : set.tracks)
  {
    double evidence = 0;  // stays 0 where the relocation found nothing
    if (!result.candidates.empty())
    {
      // A track that was not found has the fit of the best candidate and its own score.
      const Candidate& first = result.candidates.front();
      evidence = std::min(0.0, fitLogOdds(first) + leadLogOdds(track.score, first.score));
    }
    for (std::size_t k = result.candidates.size(); k-- > 0;)
    {
      if (set.trackAt(result.candidates[k].pose.mean) == &track)
      {
        evidence = inMapLogOdds(result, k);
      }
    }
    const double novelty = track.seen.add(scan, track.hypothesis.pose.mean, travelled);
    const double gain = evidence > 0
                            ? novelty * std::min(evidence, kMaxConfirmed)
                            : fresh_share * kMissWeight *
                                  std::clamp(evidence + kPriorHereLogOdds, -kMaxAgainst, 0.0);
    track.confirmed = std::clamp(track.confirmed + gain, kMinConfirmed, kMaxConfirmed);
  }
}

/// True where a pose without a track scores better than all tracks by far.
bool HypothesisTracker::State::isBeaten(const RelocationResult& result)
{
  double best_tracked = -1;
  for (const Track& track : set.tracks) best_tracked = std::max(best_tracked, track.score);
  double best_untracked = options.lost_score;
  for (const Candidate& candidate : result.candidates)
  {
    if (set.trackAt(candidate.pose.mean) == nullptr)
    {
      best_untracked = std::max(best_untracked, candidate.score);
    }
  }
  return logLikelihoodOfScore(best_untracked) - logLikelihoodOfScore(best_tracked) > kFarBetter;
}

/// Returns a new track at candidate `k`.
Track HypothesisTracker::State::startAt(const RelocationResult& result, std::size_t k,
                                        const DenseScan& scan)
{
  const Candidate& candidate = result.candidates[k];
  Track fresh;
  // The map's common error is the same for every scan. The filter would treat it as fresh noise, so
  // it is added only to the poses that are published.
  fresh.hypothesis.pose = withoutCommonError(candidate.pose, matcher->map().error());
  fresh.hypothesis.id = next_id++;
  fresh.score = fresh.mean_score = candidate.score;
  const double novelty = fresh.seen.add(scan, candidate.pose.mean, travelled);
  fresh.seen_while_tracked = fresh.seen;
  const double evidence = inMapLogOdds(result, k);
  fresh.confirmed = std::clamp(kPriorHereLogOdds + std::min(evidence, novelty * evidence),
                               kMinConfirmed, kMaxConfirmed);
  fresh.evidence = matcher->verifier()->evaluate(scan, candidate.pose.mean);
  fresh.addTrackedLogOdds(kInitialTrackedLogOdds + novelty * trackedLogOdds(fresh.evidence));
  fresh.in_field = true;
  fresh.searched_distance = searched;
  set.showTo(fresh, scan, *matcher->verifier(), travelled);
  return fresh;
}

void HypothesisTracker::State::rateFirst(const DenseScan& scan)
{
  reliability = 0;
  if (set.tracks.empty()) return;
  const mrpt::math::TPose2D& first = set.tracks.front().hypothesis.pose.mean;
  reliability = reliabilityOf(matcher->verifier()->evaluate(scan, first));
}

/// True where the scan has too little in it for the verdict *not here*.
bool HypothesisTracker::State::seesTooLittle(const ObservedScene& scene) const
{
  return landmark_tracker ? !landmark_tracker->seesEnoughToTell()
                          : scene.beams.size() < matcher->options().min_beams;
}

void HypothesisTracker::State::publish(const ObservedScene& scene)
{
  belief = {};
  belief.elsewhere = set.elsewhere;
  for (const Track& track : set.tracks)
  {
    belief.hypotheses.push_back(track.hypothesis);
    belief.hypotheses.back().pose = withCommonError(track.hypothesis.pose, matcher->map().error());
  }
  BeliefGrounds grounds;
  grounds.sees_too_little = seesTooLittle(scene);
  if (!set.tracks.empty())
  {
    belief.reliability = reliability;
    grounds.confirmed = landmark_tracker ? set.tracks.front().inMapLogOdds() >= options.confirmation
                                         : set.probabilityHere() >= options.localized_probability;
    grounds.doubtful = doubtful();
  }
  if (!landmark_tracker) publishProbabilities();
  setVerdict(belief, grounds, options.localized_probability, fieldOf(matcher->map()));
  if (belief.verdict == Verdict::localized) searched = 0;
}

/// The tracks share the probability of being in the map by their weights. The floor of "somewhere
/// else" starts new tracks and says nothing about where the robot is. Eq. (8.25)
void HypothesisTracker::State::publishProbabilities()
{
  if (set.tracks.empty()) return;
  const double here = set.probabilityHere();
  double sum = 0;
  for (TrackedHypothesis& hypothesis : belief.hypotheses)
  {
    hypothesis.weight *= here / (1.0 - options.min_elsewhere);
    sum += hypothesis.weight;
  }
  belief.elsewhere = std::max(0.0, 1.0 - sum);
}
}  // namespace sigloc
