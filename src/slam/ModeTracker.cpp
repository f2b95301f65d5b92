// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "slam/ModeTracker.h"

#include <algorithm>
#include <cmath>

#include "matching/candidate_probabilities.h"
#include "tracking/belief_verdict.h"
#include "tracking/tracks/confirmation.h"

namespace sigloc
{
namespace
{
constexpr double kLeastProbability = 0.001;  // of a candidate that the relocation left out

/// The log-odds that a relocation gives a pose of probability p, at least -2. Eq. (9.2)
double gainOf(double p)
{
  const double bounded = std::clamp(p, kLeastProbability, 1.0 - kLeastProbability);
  return std::max(std::log(bounded / (1.0 - bounded)), -kMaxAgainst);
}

/// Confirms the modes by the probabilities of the candidates. A search that was not complete says
/// nothing of a mode that it did not find. Eq. (9.2)
void confirmByProbability(TrackSet& set, const RelocationResult& result, double fresh_share)
{
  for (Track& track : set.tracks)
  {
    double p = 0;
    for (const Candidate& candidate : result.candidates)
    {
      if (set.trackAt(candidate.pose.mean) == &track) p += candidate.probability;
    }
    if (p == 0 && !result.complete) continue;
    track.confirmed =
        std::clamp(track.confirmed + fresh_share * gainOf(p), kMinInMap, kMaxConfirmed);
  }
}
}  // namespace

void ModeTracker::forget(bool known)
{
  set_ = TrackSet(options_);
  relocation_ = DenseRelocation(options_);
  schedule_ = RelocationSchedule(options_);
  if (!known) return;
  set_.elsewhere = options_.min_elsewhere;
  schedule_.noteKnownStart();
}

Travel ModeTracker::predict(const std::optional<MotionIncrement>& motion)
{
  relocation_.move(motion);
  return set_.predict(motion);
}

void ModeTracker::gather(const std::vector<ParticleMode>& modes, const SignatureMatcher& matcher)
{
  std::vector<Track> before = std::move(set_.tracks);
  set_.tracks.clear();
  for (const ParticleMode& mode : modes)
  {
    const auto known = std::find_if(
        before.begin(), before.end(),
        [&](const Track& track) { return sameMode(track.hypothesis.pose.mean, mode.pose.mean); });
    if (known != before.end())
    {
      set_.tracks.push_back(std::move(*known));
      before.erase(known);
    }
    else
    {
      set_.tracks.push_back(matcher.verifier() != nullptr ? unprovenTrack(mode.pose) : Track{});
      set_.tracks.back().hypothesis.id = next_id_++;
      set_.tracks.back().hypothesis.age = 1;  // no relocation has started it
      set_.tracks.back().searched_distance = schedule_.searched();
    }
    Track& track = set_.tracks.back();
    track.hypothesis.pose = mode.pose;
    track.hypothesis.weight = mode.weight * (1.0 - set_.elsewhere);
  }
  set_.sort();
}

bool ModeTracker::judge(const ObservedScene& scene, const SignatureMatcher& matcher,
                        const std::optional<PoseRegion>& region)
{
  const DenseVerifier* const verifier = matcher.verifier();
  DenseScan scan;
  if (verifier != nullptr)
  {
    scan = makeDenseScan(scene, kUpdateBeams);
    set_.scoreInPlace(scan, *verifier);
  }
  const Travel travel = set_.travelToScan(set_.isSuspicious());
  schedule_.countTravel(travel);
  schedule_.countSearched(travel);
  if (verifier != nullptr)
  {
    relocation_.remember(scan, schedule_.travelled());
    if (travel.with_turns > 0)
    {
      set_.addWayEvidence(scan, schedule_.travelled(), travel.distance);
      set_.updateUnexplainedShare(travel.with_turns);
      set_.addToCellEvidence(scan, *verifier, schedule_.travelled());
    }
  }
  bool relocated = schedule_.isDue(set_.isSuspicious());
  if (relocated)
  {
    relocated =
        verifier != nullptr
            ? relocation_.run(set_, schedule_,
                              {matcher, scene, scan, region, travel.with_turns > 0}, next_id_)
            : relocateByFeatures(scene, matcher, region);
  }
  set_.mergeAndPrune();
  set_.updateMeanScores(travel.with_turns);
  return relocated;
}

/// In a map without a dense field the probabilities of the candidates confirm the modes, and weigh
/// them against the others. Eq. (9.2), (9.3)
bool ModeTracker::relocateByFeatures(const ObservedScene& scene, const SignatureMatcher& matcher,
                                     const std::optional<PoseRegion>& region)
{
  const RelocationResult result = matcher.localize(scene, region);
  const double fresh_share = schedule_.freshShare();
  if (!schedule_.noteResult(result)) return false;
  const auto best = set_.bestCandidates(result, &Candidate::probability, kLeastProbability);
  set_.markBestOfMap(result);
  confirmByProbability(set_, result, fresh_share);
  set_.weighUntracked(result, std::log(best.untracked / best.tracked), fresh_share);
  const auto new_track = [&](std::size_t k)
  {
    const Candidate& candidate = result.candidates[k];
    Track fresh;
    fresh.hypothesis.pose = candidate.pose;
    fresh.hypothesis.id = next_id_++;
    fresh.confirmed = std::max(kMinInMap, gainOf(candidate.probability));
    return fresh;
  };
  set_.shareOutElsewhere(result, new_track);
  return true;
}

std::vector<ParticleMode> ModeTracker::started() const
{
  std::vector<ParticleMode> modes;
  for (const Track& track : set_.tracks)
  {
    if (!track.isNew()) continue;
    modes.push_back({track.hypothesis.pose, track.hypothesis.weight / (1.0 - set_.elsewhere)});
  }
  return modes;
}

Belief ModeTracker::publish(const SignatureMatcher& matcher, bool blind)
{
  Belief belief = beliefOf(set_, matcher.map());
  for (TrackedHypothesis& hypothesis : belief.hypotheses)
  {
    hypothesis.pose.covariance(2, 2) += kMinTurnSigma * kMinTurnSigma;
  }
  const double reliability = set_.tracks.empty() ? 0 : reliabilityOf(set_.tracks.front().evidence);
  concludeBelief(belief, set_, schedule_, matcher.map(), {blind, set_.isDoubtful(), reliability});
  return belief;
}
}  // namespace sigloc
