// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How SignatureMonteCarlo2D judges its particles: how sure their pose is, and whether the robot is
// lost.

#include <algorithm>
#include <cmath>

#include "geometry/same_place.h"
#include "io/motion_conversion.h"
#include "matching/candidate_probabilities.h"
#include "matching/dense/DenseVerifier.h"
#include "plugin/particle_modes.h"
#include "sigloc/plugin/SignatureMonteCarlo2D.h"
#include "tracking/belief_verdict.h"
#include "tracking/tracks/travel.h"

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
constexpr std::size_t kScoreBeams = 180;  // used to score the heaviest mode
constexpr double kMaxLost = 3.0;  // log-odds
constexpr double kMaxConfirmed = 6.0;  // log-odds
constexpr double kMaxAgainst = 2.0;  // log-odds a metre
constexpr double kSure = 0.9;  // a relocation that overrules the particles
constexpr double kFarBetter = 4.0;  // log-likelihood
constexpr double kCoveredWeight = 0.01;  // share of the particles that covers a candidate
constexpr double kLeastProbability = 0.001;  // of a candidate that the relocation left out
constexpr double kSameDistance = 0.75;  // [m], a mode from one step to the next
constexpr double kSameAngle = 20.0 * M_PI / 180.0;
constexpr double kLeastTurnSigma = 0.002;  // [rad]
constexpr double kScoreMemory = 0.9;  // of the running mean of the score, per step
constexpr double kMoved = 0.15;  // [m], more than the jitter of a standing robot's particles

bool same(const TPose2D& a, const TPose2D& b)
{
  return withinReach(a, b, kSameDistance, kSameAngle);
}

/// The log-odds that one relocation adds to a pose of probability p. Eq. (9.3)
double confirmationOf(double p)
{
  const double bounded = std::clamp(p, 1e-6, 1.0 - 1e-6);
  return std::clamp(std::log(bounded / (1.0 - bounded)), -kMaxAgainst, kMaxConfirmed);
}

double probabilityAt(const RelocationResult& result, const TPose2D& pose)
{
  double probability = 0;
  for (const Candidate& candidate : result.candidates)
  {
    if (same(candidate.pose.mean, pose)) probability += candidate.probability;
  }
  return probability;
}
}  // namespace

/// Moves the modes as the robot moved; returns the travel. Eq. (8.2)
double SignatureMonteCarlo2D::predictModes(const mrpt::obs::CActionCollection* action)
{
  std::optional<mrpt::poses::CPosePDFGaussian> known;
  if (action != nullptr) known = detail::motionOf(*action).motion;
  motion_known_ =
      known && std::sqrt(known->cov(0, 0) + known->cov(1, 1)) < tracking_.free_motion_sigma;
  if (!known) return tracking_.lost_distance;
  const MotionIncrement motion = detail::toMotionIncrement(*known);
  for (Mode& mode : modes_)
  {
    mode.hypothesis.pose.mean = mode.hypothesis.pose.mean + motion.mean;
    ++mode.hypothesis.age;
  }
  return travelOf(motion.mean, tracking_);
}

/// Finds the modes of the particles. A mode keeps its identity from step to step.
void SignatureMonteCarlo2D::gatherModes()
{
  std::vector<Mode> before = std::move(modes_);
  modes_.clear();
  if (lost_) return;
  for (const ParticleMode& found : modesOf(*this, tracking_.max_hypotheses))
  {
    const auto known = std::find_if(before.begin(), before.end(),
                                    [&](const Mode& mode)
                                    { return same(mode.hypothesis.pose.mean, found.pose.mean); });
    Mode mode;
    if (known != before.end())
    {
      mode = *known;
      before.erase(known);
    }
    else
    {
      mode.hypothesis.id = next_id_++;
    }
    mode.hypothesis.pose = found.pose;
    mode.hypothesis.weight = found.weight;
    modes_.push_back(mode);
  }
}

/// Without odometry only the particles show whether the robot moves. A robot that stands still
/// learns nothing from another scan.
double SignatureMonteCarlo2D::travelSeen(double assumed)
{
  if (motion_known_ || modes_.empty() || score_ < tracking_.lost_score) return assumed;
  const TPose2D now = modes_.front().hypothesis.pose.mean;
  const TPose2D before = seen_.value_or(now);
  const double moved = travelBetween(before, now, tracking_);
  if (seen_ && moved < kMoved) return 0;
  seen_ = now;
  return moved;
}

/// "Somewhere else" gains where the heaviest mode does not explain what is seen. Eq. (9.4)
void SignatureMonteCarlo2D::weighElsewhere(const ObservedScene& scene, double travel)
{
  const DenseVerifier* const verifier = matcher_->verifier();
  if (modes_.empty() || verifier == nullptr || scene.beams.empty()) return;
  const TrackedHypothesis& first = modes_.front().hypothesis;
  const DenseEvidence evidence =
      verifier->evaluate(makeDenseScan(scene, kScoreBeams), first.pose.mean);
  score_ = evidence.score;
  reliability_ = reliabilityOf(evidence);
  const bool fresh = first.age < 2;
  mean_score_ = fresh ? score_ : kScoreMemory * mean_score_ + (1 - kScoreMemory) * score_;
  const double share = std::min(1.0, travel / tracking_.lost_distance);
  const double for_lost = logLikelihoodOfScore(tracking_.lost_score) - logLikelihoodOfScore(score_);
  addLostLogOdds(share * std::clamp(for_lost, -kMaxLost, kMaxLost));
}

void SignatureMonteCarlo2D::addLostLogOdds(double log_odds)
{
  const double odds = elsewhere_ / std::max(1e-9, 1 - elsewhere_) * std::exp(log_odds);
  elsewhere_ = std::clamp(odds / (1 + odds), tracking_.min_elsewhere, 1 - tracking_.min_elsewhere);
}

/// True at the start and after a sudden fall of the score. Also true at regular distances: short
/// ones while the pose is not localized, longer ones to confirm it.
bool SignatureMonteCarlo2D::wantsRelocation() const
{
  if (lost_ && !relocated_since_lost_) return true;
  if (!lost_ && score_ < mean_score_ - tracking_.score_drop) return true;
  return travel_since_relocation_ >= (belief_.verdict == Verdict::localized
                                          ? tracking_.confirmation_distance
                                          : tracking_.relocation_distance);
}

/// A relocation does not use the particles. So it is independent evidence.
void SignatureMonteCarlo2D::relocate(const ObservedScene& scene)
{
  const double fresh_share =
      lost_ ? 1.0 : std::min(1.0, travel_since_relocation_ / tracking_.evidence_distance);
  const RelocationResult result = matcher_->localize(scene, lost_ ? region_ : std::nullopt);
  relocated_ = relocated_since_lost_ = true;
  travel_since_relocation_ = 0;
  if (result.verdict == Verdict::too_little_seen) return;
  const bool contradicts = !lost_;
  if (!lost_) weighAgainst(result, fresh_share);
  if (result.candidates.empty() || (lost_ && result.verdict == Verdict::not_here)) return;
  const std::uint64_t first_new = next_id_;
  drawFrom(result);
  gatherModes();
  for (Mode& mode : modes_)
  {
    // A pose that contradicts the particles must be found again.
    if (mode.hypothesis.id < first_new || contradicts) continue;
    mode.confirmed = confirmationOf(probabilityAt(result, mode.hypothesis.pose.mean));
  }
  weighElsewhere(scene, 0);
}

/// The lead, as log-odds, of the best candidate that no particles cover over the poses that they
/// cover. \cite algorithm eq. (9.2)
double SignatureMonteCarlo2D::leadOfRivals(const RelocationResult& result) const
{
  const bool dense = matcher_->verifier() != nullptr;
  double covered = dense ? score_ : kLeastProbability;
  double rival = dense ? tracking_.lost_score : kLeastProbability;
  for (const Candidate& candidate : result.candidates)
  {
    double& best = weightNear(*this, candidate.pose.mean) >= kCoveredWeight ? covered : rival;
    best = std::max(best, dense ? candidate.score : candidate.probability);
  }
  return dense ? logLikelihoodOfScore(rival) - logLikelihoodOfScore(covered)
               : std::log(rival / covered);
}

/// Confirms the modes, eq. (9.3). Weighs the candidates that they cover against the others, eq.
/// (9.2).
void SignatureMonteCarlo2D::weighAgainst(const RelocationResult& result, double fresh_share)
{
  const double lead = leadOfRivals(result);
  const bool far_better = lead > kFarBetter;
  for (Mode& mode : modes_)
  {
    double evidence = confirmationOf(probabilityAt(result, mode.hypothesis.pose.mean));
    // Look-alikes that have long been ruled out don't count against a confirmed pose.
    if (mode.confirmed >= tracking_.confirmation && !far_better) evidence = std::max(evidence, 0.0);
    mode.confirmed = std::min(kMaxConfirmed, mode.confirmed + fresh_share * evidence);
  }
  const bool confirmed = !modes_.empty() && modes_.front().confirmed >= tracking_.confirmation;
  const double for_lost = std::clamp(lead, -kMaxLost, confirmed && !far_better ? 0.0 : kMaxLost);
  addLostLogOdds(fresh_share * for_lost);
  const bool overruled = !result.candidates.empty() &&
                         result.candidates.front().probability >= kSure &&
                         weightNear(*this, result.candidates.front().pose.mean) < kCoveredWeight;
  if (overruled) elsewhere_ = std::max(elsewhere_, tracking_.suspicion);
}

void SignatureMonteCarlo2D::publish(bool blind)
{
  belief_ = {};
  belief_.elsewhere = lost_ ? 1.0 : elsewhere_;
  const double here = 1 - belief_.elsewhere;
  for (const Mode& mode : modes_)
  {
    TrackedHypothesis hypothesis = mode.hypothesis;
    hypothesis.weight *= here;
    // The particles' covariance lacks the common error of a whole neighbourhood of the map.
    hypothesis.pose = withCommonError(hypothesis.pose, matcher_->map().error());
    hypothesis.pose.covariance(2, 2) += kLeastTurnSigma * kLeastTurnSigma;
    belief_.hypotheses.push_back(hypothesis);
  }
  BeliefGrounds grounds;
  grounds.sees_too_little = blind;
  if (!modes_.empty())
  {
    belief_.reliability = reliability_;
    grounds.confirmed = modes_.front().confirmed >= tracking_.confirmation;
  }
  const auto& field = matcher_->map().field();
  setVerdict(belief_, grounds, tracking_.localized_probability, field ? &*field : nullptr);
}
}  // namespace sigloc
