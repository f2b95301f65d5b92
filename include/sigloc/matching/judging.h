// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sigloc/matching/DenseVerifier.h"
#include "sigloc/matching/SignatureMatcher.h"

namespace sigloc
{
/// Runs proposals through the dense cascade and returns at most `max_candidates`, best first, with
/// all the evidence that weighing takes: scores and shares, and the explained facts of those that
/// score within DenseVerifier::kContender of the first. Covariances and probabilities are left to
/// the caller. \cite algorithm section 6
std::vector<Candidate> judgedCandidates(const DenseVerifier& verifier, const ObservedScene& scene,
                                        const DenseScan& scan,
                                        const std::vector<PoseProposal>& proposals,
                                        std::size_t max_candidates, std::uint64_t& poses_scored);

/// Returns how much of the circle around its sensors a scene shows returns in, by sectors of
/// 15 degrees [rad].
double viewOf(const ObservedScene& scene);
}  // namespace sigloc
