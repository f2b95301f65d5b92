// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/matching/FeatureHypothesis.h"
#include "sigloc/matching/FeatureVerifier.h"

#include <cstdint>
#include <vector>

namespace sigloc
{
/// A rival that explains less than this share of what the best hypothesis explains is worse by so
/// many log-odds that it cannot change the verdict; one that explains more must not be missed.
constexpr double kRivalShare = 0.9;

/// Number of draws t after which all fail with probability `failure` when one succeeds with
/// probability `success`. \cite algorithm eq. (4.3)
std::uint32_t drawsNeeded(double failure, double success);

/// Returns the observed features of a hypothesis' pairings, ascending.
std::vector<std::uint32_t> observedOf(const FeatureHypothesis& hypothesis);

/// Returns the best hypotheses found, with what chance would have given.
std::vector<FeatureHypothesis> rankedHypotheses(const PreparedScene& scene,
                                                const FeatureVerifier& verifier,
                                                const HypothesisSet& found, std::uint32_t base_size,
                                                std::uint64_t bases);
}  // namespace sigloc
