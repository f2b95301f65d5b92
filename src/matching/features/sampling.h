// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/features/FeatureHypothesis.h"
#include "matching/features/FeatureVerifier.h"

#include <cstdint>
#include <vector>

namespace sigloc
{
/// Of the bases of `size` features that the best hypothesis explains, `explained` in number, the
/// share that a rival still has. A rival lacks a tenth of them at most, or two where that is less
/// than two: one that explains less is worse by so many log-odds that it cannot change the verdict;
/// one that explains more must not be missed. \cite algorithm eq. (4.4)
double rivalShare(std::size_t explained, std::size_t size);

/// How many sets of k there are among n, 0 for n < k.
double combinations(std::size_t n, std::size_t k);

/// Number of draws t after which all fail with probability `failure` when one succeeds with
/// probability `success`; the largest there is when none can. \cite algorithm eq. (4.3)
std::uint32_t drawsNeeded(double failure, double success);

/// Returns the observed features of a hypothesis' pairings, ascending.
std::vector<std::uint32_t> observedOf(const FeatureHypothesis& hypothesis);

/// Returns the best hypotheses found, with what chance would have given.
std::vector<FeatureHypothesis> rankedHypotheses(const PreparedScene& scene,
                                                const FeatureVerifier& verifier,
                                                const HypothesisSet& found, std::uint32_t base_size,
                                                std::uint64_t bases);
}  // namespace sigloc
