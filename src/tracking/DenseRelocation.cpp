// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/DenseRelocation.h"

#include "tracking/tracks/confirmation.h"

namespace sigloc
{
bool DenseRelocation::run(TrackSet& set, RelocationSchedule& schedule, const RelocationInput& input,
                          std::uint64_t& next_id) const
{
  const SignatureMatcher& matcher = input.matcher;
  const DenseScan& scan = input.scan;
  const RelocationResult result = matcher.localize(input.scene, input.region);
  const double fresh_share = schedule.freshShare();
  if (!schedule.noteResult(result)) return false;
  const DenseVerifier& verifier = *matcher.verifier();
  const double travelled = schedule.travelled();

  set.markBestOfMap(result);
  if (input.moved) confirmTracks(set, result, scan, travelled, fresh_share);
  set.raiseElsewhereIfOverruled(result, leadOfUntracked(set, result));
  const auto new_track = [&](std::size_t k)
  {
    Track fresh = trackAtCandidate(result, k, scan, verifier, travelled);
    // The map's common error is the same for every scan. The filter would treat it as fresh noise,
    // so it is added only to the poses that are published.
    fresh.hypothesis.pose = withoutCommonError(fresh.hypothesis.pose, matcher.map().error());
    fresh.hypothesis.id = next_id++;
    fresh.searched_distance = schedule.searched();
    set.addToCellEvidence(fresh, scan, verifier, travelled);
    return fresh;
  };
  set.shareOutElsewhere(result, new_track);
  set.weighNewTracksAmongThemselves();
  past_.weighNewTracksAgainstOlder(set, scan, verifier, travelled);
  return true;
}
}  // namespace sigloc
