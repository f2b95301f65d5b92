// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "matching/dense/DenseVerifier.h"
#include "sigloc/matching/RelocationResult.h"
#include "tracking/tracks/Track.h"
#include "tracking/tracks/TrackSet.h"

namespace sigloc
{
/// Returns a track in a dense field of which nothing is known yet but its pose.
Track unprovenTrack(const GaussianPose& pose);

/// Returns a new track at candidate `k` of a relocation, without id, weight and observed cells. The
/// scan was taken after `travelled` [m] in all. Eq. (8.7), (8.21)
Track trackAtCandidate(const RelocationResult& result, std::size_t k, const DenseScan& scan,
                       const DenseVerifier& verifier, double travelled);

/// Adds what a relocation says to the in-map log-odds of the tracks. Evidence for a track counts by
/// the share of structure that is new to the track: a second scan of a room repeats the likeness of
/// the first. Evidence against it counts by `fresh_share` in [0, 1]. Eq. (8.7)
void confirmTracks(TrackSet& set, const RelocationResult& result, const DenseScan& scan,
                   double travelled, double fresh_share);

/// Returns the lead, in log-likelihood of scores (7.1), of the best candidate without a track over
/// the best track. \cite algorithm section 8, "Relocate"
double leadOfUntracked(const TrackSet& set, const RelocationResult& result);
}  // namespace sigloc
