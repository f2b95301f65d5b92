// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/features/FeatureHypothesis.h"

#include <cstdint>
#include <vector>

namespace sigloc
{
/// Returns the share that a rival has of the bases of `size` features, where the best hypothesis
/// explains `explained` features. A rival lacks a tenth of the features, or two if that is more.
/// One that lacks more cannot change the verdict. One that lacks less must not be missed. \cite
/// algorithm eq. (4.4)
double rivalShare(std::size_t explained, std::size_t size);

/// Returns the number of sets of k among n; 0 for n < k.
double combinations(std::size_t n, std::size_t k);

/// Returns the number of draws t that all fail with probability `failure`, where one succeeds with
/// probability `success`. It is the largest number where none can succeed.
/// \cite algorithm eq. (4.3)
std::uint32_t drawsNeeded(double failure, double success);

/// Returns the observed features of a hypothesis' pairings, ascending.
std::vector<std::uint32_t> observedOf(const FeatureHypothesis& hypothesis);
}  // namespace sigloc
