// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/tracking/HypothesisTracker.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "sigloc/geometry/pose_fusion.h"
#include "sigloc/matching/DenseVerifier.h"
#include "sigloc/matching/weighing.h"

namespace sigloc
{
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr std::size_t kUpdateBeams = 180;  // a track is updated with
constexpr int kUpdateSteps = 6;
constexpr double kUpdateGate = 16.27;  // chi-square, 3 degrees of freedom, 99.9 %
constexpr double kSameDistance = 0.5;  // [m], a proposal this near to a track confirms it
constexpr double kSameAngle = 17.0 * M_PI / 180.0;
constexpr double kMergeDistance = 0.3;  // [m]
constexpr double kMergeAngle = 10.0 * M_PI / 180.0;
constexpr double kMaxOpenSigma = 0.5;  // [m], a wider pose is a line of poses
constexpr double kNotHere = 0.98;
constexpr double kMaxRelative = 3.0;  // log-odds one unit of travel can tell at most
constexpr double kMaxLost = 3.0;
constexpr double kMaxConfirmed = 6.0;  // what was confirmed long ago can still be lost
constexpr double kFarBetter = 4.0;  // log-likelihood
constexpr double kSure = 0.9;  // a relocation that overrules all tracks
constexpr double kScoreMemory = 0.9;  // of the running mean of the score, per step
constexpr double kCorrelation = 4.0;  // scans of neighbouring steps share their errors
constexpr double kMinSigma = 0.005;  // [m], floor of a step's motion
constexpr double kMinTurnSigma = 0.002;  // [rad]

struct Track
{
  TrackedHypothesis hypothesis;
  double score = 0;  // of the last scan
  double mean_score = 0;  // running mean
  double confirmed = 0;  // log-odds that relocations, each blind to the track, have given it
};

/// What one relocation says of a pose it gives probability p, as clipped log-odds.
double confirmationOf(double p)
{
  constexpr double kAgainst = -2.0;
  constexpr double kFor = 4.6;
  const double bounded = std::clamp(p, 1e-6, 1.0 - 1e-6);
  return std::clamp(std::log(bounded / (1.0 - bounded)), kAgainst, kFor);
}

bool coincide(const TPose2D& a, const TPose2D& b, double distance, double angle)
{
  return std::hypot(a.x - b.x, a.y - b.y) <= distance && std::abs(wrapToPi(a.phi - b.phi)) <= angle;
}

bool heavier(const Track& a, const Track& b)
{
  if (a.hypothesis.weight != b.hypothesis.weight) return a.hypothesis.weight > b.hypothesis.weight;
  return a.hypothesis.id < b.hypothesis.id;
}
}  // namespace

struct HypothesisTracker::State
{
  State(std::shared_ptr<const SignatureMatcher> m, const TrackerOptions& o)
      : matcher(std::move(m)), options(o)
  {
  }

  void predict(const std::optional<MotionIncrement>& motion);
  void update(const DenseScan& scan);
  void updatePose(Track& track, const DenseScan& scan) const;
  void weigh();
  bool suspicious() const;
  bool wantsRelocation() const;
  void relocate(const ObservedScene& scene);
  void confirm(const RelocationResult& result, double fresh_share);
  void normalise();
  Track* trackAt(const TPose2D& pose);
  void mergeAndPrune();
  void publish(const ObservedScene& scene);

  std::shared_ptr<const SignatureMatcher> matcher;
  TrackerOptions options;
  std::optional<PoseRegion> region;
  std::vector<Track> tracks;
  double elsewhere = 1;  // weight of "somewhere else"
  std::uint64_t next_id = 1;
  double travel_step = 0;  // [m], turns included, of the last motion
  double travel_since_relocation = 0;  // [m]
  bool first_step = true;
  bool relocated = false;
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
bool HypothesisTracker::relocated() const
{
  return state_->relocated;
}

void HypothesisTracker::reset(const std::optional<PoseRegion>& region)
{
  state_->region = region;
  state_->tracks.clear();
  state_->elsewhere = 1;
  state_->first_step = true;
  state_->belief = {};
}

const Belief& HypothesisTracker::step(const std::optional<MotionIncrement>& motion,
                                      const ObservedScene& scene)
{
  State& s = *state_;
  s.predict(motion);
  s.relocated = false;
  const bool sees_enough = scene.beams.size() >= s.matcher->options().min_beams;
  if (sees_enough && s.matcher->verifier() != nullptr)
  {
    s.update(makeDenseScan(scene, kUpdateBeams));
    s.weigh();
    if (s.wantsRelocation()) s.relocate(scene);
    s.mergeAndPrune();
    s.first_step = false;
  }
  s.publish(scene);
  return s.belief;
}

void HypothesisTracker::State::predict(const std::optional<MotionIncrement>& motion)
{
  MotionIncrement increment;
  if (motion)
  {
    increment = *motion;
    increment.covariance(0, 0) += kMinSigma * kMinSigma;
    increment.covariance(1, 1) += kMinSigma * kMinSigma;
    increment.covariance(2, 2) += kMinTurnSigma * kMinTurnSigma;
  }
  else
  {
    increment.covariance(0, 0) = options.free_motion_sigma * options.free_motion_sigma;
    increment.covariance(1, 1) = increment.covariance(0, 0);
    increment.covariance(2, 2) = options.free_turn_sigma * options.free_turn_sigma;
  }
  const double turn_as_travel =
      std::abs(increment.mean.phi) * options.evidence_distance / options.evidence_turn;
  travel_step = motion ? std::hypot(increment.mean.x, increment.mean.y) + turn_as_travel
                       : options.lost_distance;
  travel_since_relocation += travel_step;
  for (Track& track : tracks)
  {
    track.hypothesis.pose = composeWithMotion(track.hypothesis.pose, increment);
    ++track.hypothesis.age;
  }
}

void HypothesisTracker::State::update(const DenseScan& scan)
{
  for (Track& track : tracks) updatePose(track, scan);
}

/// The returns' own estimate near the predicted pose, fused with the prediction. A refinement that
/// the prediction excludes is taken only when it explains the scan clearly better: odometry slips.
void HypothesisTracker::State::updatePose(Track& track, const DenseScan& scan) const
{
  constexpr double kClearlyBetter = 0.15;  // of the score
  const DenseVerifier& verifier = *matcher->verifier();
  GaussianPose& pose = track.hypothesis.pose;
  const double predicted_score = verifier.evaluate(scan, pose.mean).score;
  GaussianPose measured;
  measured.mean = verifier.refine(scan, pose.mean, kUpdateSteps, scan.size());
  measured.covariance = verifier.covarianceAt(scan, measured.mean, 0.0);
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c) measured.covariance(r, c) *= kCorrelation;
  }
  const double measured_score = verifier.evaluate(scan, measured.mean).score;
  if (squaredMahalanobisDistance(pose, measured) < kUpdateGate)
  {
    pose = fusePoses(pose, measured);
    track.score = std::max(predicted_score, measured_score);
  }
  else if (measured_score > predicted_score + kClearlyBetter)
  {
    pose = measured;
    track.score = measured_score;
  }
  else
  {
    track.score = predicted_score;
  }
}

/// Rivals are weighed against each other by how well each explains the scan, per distance driven:
/// the errors of map and scan stay the same for a stretch. Against "somewhere else" the best of
/// them is weighed by its score alone, and sooner.
void HypothesisTracker::State::weigh()
{
  if (tracks.empty()) return;
  const double best_score =
      std::max_element(tracks.begin(), tracks.end(),
                       [](const Track& a, const Track& b) { return a.score < b.score; })
          ->score;
  const double best = logLikelihoodOfScore(best_score);
  const double between = std::min(1.0, travel_step / options.evidence_distance);
  for (Track& track : tracks)
  {
    const double behind = std::max(logLikelihoodOfScore(track.score) - best, -kMaxRelative);
    track.hypothesis.weight *= std::exp(between * behind);
  }
  const double lost = std::min(1.0, travel_step / options.lost_distance);
  const double for_lost =
      std::clamp(logLikelihoodOfScore(options.lost_score) - best, -kMaxLost, kMaxLost);
  elsewhere *= std::exp(lost * for_lost);
  normalise();
}

void HypothesisTracker::State::normalise()
{
  double sum = elsewhere;
  for (const Track& track : tracks) sum += track.hypothesis.weight;
  for (Track& track : tracks) track.hypothesis.weight /= sum;
  elsewhere /= sum;
}

/// The heaviest track suddenly explains much less than it used to: kidnapped, or a slip.
bool HypothesisTracker::State::suspicious() const
{
  if (tracks.empty()) return false;
  const Track& first = *std::min_element(tracks.begin(), tracks.end(), heavier);
  return first.hypothesis.age > 1 && first.score < first.mean_score - options.score_drop;
}

/// At the start, after a sudden fall of the score, at a steady rate while several poses or none
/// hold, and at a low one to confirm what is held.
bool HypothesisTracker::State::wantsRelocation() const
{
  if (first_step || suspicious()) return true;
  return travel_since_relocation >= (belief.verdict == Verdict::localized
                                         ? options.confirmation_distance
                                         : options.relocation_distance);
}

Track* HypothesisTracker::State::trackAt(const TPose2D& pose)
{
  for (Track& track : tracks)
  {
    if (coincide(track.hypothesis.pose.mean, pose, kSameDistance, kSameAngle)) return &track;
  }
  return nullptr;
}

/// A relocation knows nothing of the tracks. Where it finds poses that no track holds, as good as
/// theirs, "somewhere else" gains; the lost share of the belief is then dealt out as the relocation
/// says: to tracks that it confirms, to new ones, and back to "somewhere else".
void HypothesisTracker::State::relocate(const ObservedScene& scene)
{
  const double fresh_share =
      first_step ? 1.0 : std::min(1.0, travel_since_relocation / options.evidence_distance);
  const RelocationResult result = matcher->localize(scene, first_step ? region : std::nullopt);
  relocated = true;
  travel_since_relocation = 0;
  if (result.verdict == Verdict::too_little_seen) return;

  confirm(result, fresh_share);
  const double lost = elsewhere;
  elsewhere = lost * result.elsewhere;
  for (const Candidate& candidate : result.candidates)
  {
    const double share = lost * candidate.probability;
    if (Track* same = trackAt(candidate.pose.mean))
    {
      same->hypothesis.weight += share;
      continue;
    }
    Track fresh;
    fresh.hypothesis.pose = candidate.pose;
    fresh.hypothesis.weight = share;
    fresh.hypothesis.id = next_id++;
    fresh.score = fresh.mean_score = candidate.score;
    fresh.confirmed = confirmationOf(candidate.probability);
    tracks.push_back(fresh);
  }
}

void HypothesisTracker::State::confirm(const RelocationResult& result, double fresh_share)
{
  if (tracks.empty()) return;
  double best_tracked = -1;
  for (const Track& track : tracks) best_tracked = std::max(best_tracked, track.score);
  double best_untracked = options.lost_score;
  for (const Candidate& candidate : result.candidates)
  {
    if (trackAt(candidate.pose.mean) == nullptr)
    {
      best_untracked = std::max(best_untracked, candidate.score);
    }
  }
  for (Track& track : tracks)
  {
    double probability = 0;
    double rival = 0;
    for (const Candidate& candidate : result.candidates)
    {
      if (trackAt(candidate.pose.mean) == &track)
      {
        probability += candidate.probability;
      }
      else
      {
        rival = std::max(rival, candidate.score);
      }
    }
    double evidence = confirmationOf(probability);
    // Look-alikes that a confirmed track has long ruled out don't count against it; a pose that
    // explains the scan far better does.
    const bool far_better =
        logLikelihoodOfScore(rival) - logLikelihoodOfScore(track.score) > kFarBetter;
    if (track.confirmed >= options.confirmation && evidence < 0 && !far_better) evidence = 0;
    track.confirmed = std::min(kMaxConfirmed, track.confirmed + fresh_share * evidence);
  }
  double here = std::clamp(hereLogOdds(best_tracked, best_untracked), -kMaxLost, kMaxLost);
  const bool held =
      std::any_of(tracks.begin(), tracks.end(),
                  [&](const Track& track) { return track.confirmed >= options.confirmation; });
  const bool beaten =
      logLikelihoodOfScore(best_untracked) - logLikelihoodOfScore(best_tracked) > kFarBetter;
  if (held && !beaten) here = std::max(here, 0.0);
  elsewhere *= std::exp(-fresh_share * here);
  const bool overruled = !result.candidates.empty() &&
                         result.candidates.front().probability >= kSure &&
                         trackAt(result.candidates.front().pose.mean) == nullptr;
  if (overruled) elsewhere = std::max(elsewhere, options.suspicion);
  normalise();
}

void HypothesisTracker::State::mergeAndPrune()
{
  std::sort(tracks.begin(), tracks.end(), heavier);
  std::vector<Track> kept;
  for (const Track& track : tracks)
  {
    const auto same =
        std::find_if(kept.begin(), kept.end(),
                     [&](const Track& other)
                     {
                       return coincide(other.hypothesis.pose.mean, track.hypothesis.pose.mean,
                                       kMergeDistance, kMergeAngle);
                     });
    if (same != kept.end())
    {
      TrackedHypothesis& into = same->hypothesis;
      into.pose =
          mergeByMoments(into.pose, into.weight, track.hypothesis.pose, track.hypothesis.weight);
      into.weight += track.hypothesis.weight;
      into.id = std::min(into.id, track.hypothesis.id);
      same->confirmed = std::max(same->confirmed, track.confirmed);
      into.age = std::max(into.age, track.hypothesis.age);
    }
    else if (kept.size() < options.max_hypotheses &&
             track.hypothesis.weight >= options.prune_weight)
    {
      kept.push_back(track);
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
  const double keep = std::min(here, 1.0 - options.min_elsewhere);
  for (Track& track : tracks) track.hypothesis.weight *= here > 0 ? keep / here : 0;
  elsewhere = 1.0 - (here > 0 ? keep : 0);
}

void HypothesisTracker::State::publish(const ObservedScene& scene)
{
  belief = {};
  belief.elsewhere = elsewhere;
  const double common = matcher->map().error().common_sigma;
  for (const Track& track : tracks)
  {
    belief.hypotheses.push_back(track.hypothesis);
    belief.hypotheses.back().pose.covariance(0, 0) += common * common;
    belief.hypotheses.back().pose.covariance(1, 1) += common * common;
  }
  if (tracks.empty())
  {
    const bool blind = scene.beams.size() < matcher->options().min_beams;
    belief.verdict = blind ? Verdict::too_little_seen : Verdict::not_here;
    belief.probability = elsewhere;
    belief.reason = blind ? "fewer returns than needed" : "nothing in the map explains the scan";
    return;
  }
  const TrackedHypothesis& first = belief.hypotheses.front();
  belief.reliability = 1.0 / (1.0 + std::exp(logLikelihoodOfScore(options.lost_score) -
                                             logLikelihoodOfScore(tracks.front().score)));
  const bool open = largestPositionSigma(first.pose) >= kMaxOpenSigma;
  const bool confirmed = tracks.front().confirmed >= options.confirmation;
  if (first.weight >= options.localized_probability && confirmed && !open)
  {
    belief.verdict = Verdict::localized;
    belief.probability = first.weight;
    belief.reason = "one hypothesis holds";
  }
  else if (elsewhere >= kNotHere)
  {
    belief.verdict = Verdict::not_here;
    belief.probability = elsewhere;
    belief.reason = "no hypothesis explains the scan";
  }
  else
  {
    belief.verdict = Verdict::ambiguous;
    belief.probability = 1.0 - first.weight;
    belief.reason = open         ? "the position is open along a line"
                    : !confirmed ? "relocation has not confirmed the hypothesis yet"
                                 : std::to_string(tracks.size()) + " hypotheses remain";
  }
}
}  // namespace sigloc
