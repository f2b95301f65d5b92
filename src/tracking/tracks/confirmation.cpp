// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/confirmation.h"

#include <algorithm>

#include "matching/candidate_probabilities.h"

namespace sigloc
{
namespace
{
constexpr double kMissWeight = 0.5;  // factor of the evidence against a track, eq. (8.7)

/// What a relocation says of a track: the log-odds of the candidate that it found there. A track
/// that it did not find has the fit of the best candidate and its own score; a search that was not
/// complete says nothing of it.
double evidenceFor(const Track& track, const TrackSet& set, const RelocationResult& result)
{
  if (result.candidates.empty()) return 0;
  for (std::size_t k = 0; k < result.candidates.size(); ++k)
  {
    if (set.trackAt(result.candidates[k].pose.mean) == &track) return inMapLogOdds(result, k);
  }
  if (!result.complete) return 0;
  const Candidate& first = result.candidates.front();
  return std::min(0.0, fitLogOdds(first) + leadLogOdds(track.score, first.score));
}
}  // namespace

Track unprovenTrack(const GaussianPose& pose)
{
  Track track;
  track.hypothesis.pose = pose;
  track.in_field = true;
  return track;
}

Track trackAtCandidate(const RelocationResult& result, std::size_t k, const DenseScan& scan,
                       const DenseVerifier& verifier, double travelled)
{
  const Candidate& candidate = result.candidates[k];
  Track track = unprovenTrack(candidate.pose);
  track.score = track.mean_score = candidate.score;
  const double novelty = track.seen_at_relocations.add(scan, candidate.pose.mean, travelled);
  track.seen_while_tracked = track.seen_at_relocations;
  const double evidence = inMapLogOdds(result, k);
  track.confirmed = std::clamp(kPriorHereLogOdds + std::min(evidence, novelty * evidence),
                               kMinInMap, kMaxConfirmed);
  track.evidence = verifier.evaluate(scan, candidate.pose.mean);
  track.addTrackedLogOdds(novelty * trackedLogOdds(track.evidence));
  return track;
}

void confirmTracks(TrackSet& set, const RelocationResult& result, const DenseScan& scan,
                   double travelled, double fresh_share)
{
  for (Track& track : set.tracks)
  {
    const double evidence = evidenceFor(track, set, result);
    const double novelty =
        track.seen_at_relocations.add(scan, track.hypothesis.pose.mean, travelled);
    const double gain = evidence > 0
                            ? novelty * std::min(evidence, kMaxConfirmed)
                            : fresh_share * kMissWeight *
                                  std::clamp(evidence + kPriorHereLogOdds, -kMaxAgainst, 0.0);
    track.confirmed = std::clamp(track.confirmed + gain, kMinInMap, kMaxConfirmed);
  }
}

double leadOfUntracked(const TrackSet& set, const RelocationResult& result)
{
  constexpr double kWorst = -1.0;  // of scores
  const double tracked = set.tracks.empty() ? kWorst : std::max(kWorst, set.bestScore());
  const double untracked = set.bestCandidates(result, &Candidate::score, kWorst).untracked;
  return logLikelihoodOfScore(untracked) - logLikelihoodOfScore(tracked);
}
}  // namespace sigloc
