// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/features/Feature.h"
#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/matching/RelocationResult.h"

#include <cstdint>
#include <vector>

namespace sigloc
{
/// A pose that a set of jointly compatible pairings supports.
struct FeatureHypothesis
{
  GaussianPose pose;
  std::vector<FeaturePairing> pairings;
  std::uint32_t support = 0;  ///< pairings that count: a corner does not beside its own wall
  double log_odds = 0;  ///< against "all clutter", \cite algorithm eq. (5.10)
  /// How many hypotheses with this support are expected by chance among all bases retrieved: below
  /// `GeneratorOptions::significance` chance is refuted. \cite algorithm eq. (5.12)
  double chance = 1;
};

/// A way of generating pose hypotheses from features alone: modes (a) to (d) of the method.
class FeatureHypothesisGenerator
{
 public:
  virtual ~FeatureHypothesisGenerator() = default;

  /// Returns distinct verified hypotheses, best first. Thread-safe: const, no shared state.
  virtual std::vector<FeatureHypothesis> generate(const std::vector<Feature>& observed,
                                                  MatchingCounters& counters) const = 0;
};
}  // namespace sigloc
