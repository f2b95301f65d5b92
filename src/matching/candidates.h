// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "matching/dense/DenseVerifier.h"
#include "sigloc/matching/SignatureMatcher.h"

namespace sigloc
{
/// Returns ranked poses as candidates with the evidence for their probabilities: scores, shares,
/// and the explained constraints of those within DenseVerifier::kContender of the first. The caller
/// sets covariances and probabilities. \cite algorithm sections 6 and 7
std::vector<Candidate> candidatesOf(const std::vector<RankedPose>& ranked,
                                    const DenseVerifier& verifier, const ObservedScene& scene);

/// Returns the angular coverage [rad] of a scene: the sectors of 15 degrees around its sensors in
/// which it has returns. \cite algorithm section 7, "Here or elsewhere"
double angularCoverage(const ObservedScene& scene);
}  // namespace sigloc
