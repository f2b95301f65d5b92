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

bool TrackSet::retainsAny() const
{
  return std::any_of(tracks.begin(), tracks.end(),
                     [&](const Track& track) { return track.retained(sureLogOdds(options_)); });
}

void TrackSet::raiseElsewhereIfOverruled(const RelocationResult& result, bool beaten)
{
  if (tracks.empty() || result.candidates.empty() || (!beaten && retainsAny())) return;
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
