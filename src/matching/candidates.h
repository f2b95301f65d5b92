// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "matching/dense/DenseVerifier.h"
#include "sigloc/matching/SignatureMatcher.h"

namespace sigloc
{
/// Returns ranked poses as candidates with all the evidence that weighing takes: scores and shares,
/// and the explained facts of those that score within DenseVerifier::kContender of the first.
/// Covariances and probabilities are left to the caller. \cite algorithm section 6
std::vector<Candidate> candidatesOf(const std::vector<RankedPose>& ranked,
                                    const DenseVerifier& verifier, const ObservedScene& scene);

/// Returns how much of the circle around its sensors a scene shows returns in, by sectors of
/// 15 degrees [rad].
double angularCoverage(const ObservedScene& scene);
}  // namespace sigloc
