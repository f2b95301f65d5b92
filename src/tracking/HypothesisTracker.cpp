// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/tracking/HypothesisTracker.h"

#include <algorithm>
#include <stdexcept>

#include "features/feature_values.h"
#include "matching/candidate_probabilities.h"
#include "matching/dense/DenseVerifier.h"
#include "tracking/belief_verdict.h"
#include "tracking/DenseRelocation.h"
#include "tracking/landmarks/LandmarkTracker.h"
#include "tracking/step_input.h"
#include "tracking/tracks/RelocationSchedule.h"
#include "tracking/tracks/TrackSet.h"

namespace sigloc
{
struct HypothesisTracker::State
{
  State(std::shared_ptr<const SignatureMatcher> m, const TrackerOptions& o)
      : matcher(std::move(m)), options(o), set(o), relocation(o), schedule(o)
  {
    startAnew();
  }

  void startAnew();
  void trackDensely(const ObservedScene& scene);
  void trackByFeatures();
  bool seesTooLittle(const ObservedScene& scene) const;
  bool suspicious() const;
  bool doubtful() const;
  std::optional<PoseRegion> regionToSearch() const;
  void rateFirst(const DenseScan& scan);
  void publish(const ObservedScene& scene);

  std::shared_ptr<const SignatureMatcher> matcher;
  TrackerOptions options;
  std::optional<PoseRegion> region;
  TrackSet set;
  DenseRelocation relocation;
  std::unique_ptr<LandmarkTracker> landmark_tracker;  // null where the map has a dense field
  std::uint64_t next_id = 1;
  RelocationSchedule schedule;
  bool relocated = false;  // in this step
  double reliability = 0;  // of the first hypothesis at the last scan with enough returns
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
  relocation = DenseRelocation(options);
  schedule = RelocationSchedule(options);
  belief = {};
  relocated = false;
  reliability = 0;
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
  const bool sees_enough = s.landmark_tracker ? s.landmark_tracker->addScan(s.set, motion, scene)
                                              : s.matcher->seesEnoughReturns(scene);
  s.set.predict(motion);
  s.relocation.move(motion);
  if (sees_enough && s.landmark_tracker)
  {
    s.trackByFeatures();
  }
  else if (sees_enough)
  {
    s.trackDensely(scene);
  }
  s.publish(scene);
  return s.belief;
}

void HypothesisTracker::State::trackDensely(const ObservedScene& scene)
{
  const DenseScan scan = makeDenseScan(scene, kUpdateBeams);
  set.refineAndScore(scan, *matcher->verifier());
  const Travel travel = set.travelToScan(suspicious());
  schedule.countTravel(travel);
  schedule.countSearched(travel);
  relocation.remember(scan, schedule.travelled());
  if (travel.with_turns > 0)  // the same scan again is no new evidence
  {
    set.addWayEvidence(scan, schedule.travelled(), travel.distance);
    set.weighRivals(scan, *matcher->verifier(), schedule.travelled(), travel.with_turns);
  }
  if (schedule.isDue(suspicious()))
  {
    relocated = relocation.run(
        set, schedule, {*matcher, scene, scan, regionToSearch(), travel.with_turns > 0}, next_id);
  }
  set.mergeAndPrune();
  set.updateMeanScores(travel.with_turns);
  rateFirst(scan);
}

void HypothesisTracker::State::trackByFeatures()
{
  landmark_tracker->update(set, schedule.travelled(), next_id);
  const Travel travel = set.travelToScan(suspicious());
  schedule.countTravel(travel);
  landmark_tracker->weigh(set, travel.with_turns);
  if (schedule.isDue(suspicious()))
  {
    const bool settled = belief.verdict == Verdict::localized && !suspicious();
    relocated = landmark_tracker->relocate(set, schedule, regionToSearch(), settled, next_id);
  }
  landmark_tracker->remember();
  set.mergeAndPrune();
  set.updateMeanScores(travel.with_turns);
  reliability = set.tracks.empty() ? 0 : landmark_tracker->reliabilityOf(set.tracks.front());
}

/// A prior region holds until a relocation has given an answer.
std::optional<PoseRegion> HypothesisTracker::State::regionToSearch() const
{
  return schedule.isWakingUp() ? region : std::nullopt;
}

/// True where the heaviest track suddenly explains much less than before: the robot was kidnapped
/// or the odometry slipped.
bool HypothesisTracker::State::suspicious() const
{
  if (!landmark_tracker) return set.isSuspicious();
  return !set.tracks.empty() && LandmarkTracker::doubts(set.heaviest());
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
                          : !matcher->seesEnoughReturns(scene);
}

/// True where suspicion stops a claim.
bool HypothesisTracker::State::doubtful() const
{
  return landmark_tracker ? suspicious() : set.isDoubtful();
}

void HypothesisTracker::State::publish(const ObservedScene& scene)
{
  belief = beliefOf(set, matcher->map());
  concludeBelief(belief, set, schedule, matcher->map(),
                 {seesTooLittle(scene), doubtful(), reliability});
}
}  // namespace sigloc
