// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
// What a relocation does to the tracks and to "somewhere else".
#include <algorithm>

#include "tracking/tracks/TrackSet.h"

namespace sigloc
{
namespace
{
constexpr double kSure = 0.9;  // probability of a candidate that overrules all tracks, section 8
}  // namespace

void TrackSet::markBestOfMap(const RelocationResult& result)
{
  const Track* best =
      result.candidates.empty() ? nullptr : trackAt(result.candidates.front().pose.mean);
  for (Track& track : tracks) track.found = &track == best;
}

TrackSet::BestCandidates TrackSet::bestCandidates(const RelocationResult& result,
                                                  double Candidate::*measure, double least) const
{
  BestCandidates best{least, least};
  for (const Candidate& candidate : result.candidates)
  {
    double& same_kind = trackAt(candidate.pose.mean) != nullptr ? best.tracked : best.untracked;
    same_kind = std::max(same_kind, candidate.*measure);
  }
  return best;
}

/// True for a lead over the tracks that is large, or where no track is retained.
bool TrackSet::mayOverrule(double lead) const
{
  const double sure = sureLogOdds(options_);
  return lead > sure || std::none_of(tracks.begin(), tracks.end(),
                                     [&](const Track& track) { return track.retained(sure); });
}

void TrackSet::weighUntracked(const RelocationResult& result, double lead, double fresh_share)
{
  if (!result.complete) return;
  const double counted = mayOverrule(lead) ? lead : std::min(0.0, lead);
  scaleOddsOfElsewhere(fresh_share * counted);
  raiseElsewhereIfOverruled(result, lead);
}

void TrackSet::raiseElsewhereIfOverruled(const RelocationResult& result, double lead)
{
  if (tracks.empty() || result.candidates.empty() || !mayOverrule(lead)) return;
  const Candidate& first = result.candidates.front();
  if (first.probability < kSure || trackAt(first.pose.mean) != nullptr) return;
  elsewhere = std::max(elsewhere, options_.suspicion);
  normalise();
}

/// The floor of "somewhere else" starts new tracks but adds nothing to existing ones. Otherwise
/// look-alikes would gain from it at every relocation. Eq. (8.9)
void TrackSet::shareOutElsewhere(const RelocationResult& result,
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
}  // namespace sigloc
