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
  std::uint32_t support = 0;  ///< pairings that count: not a corner whose wall is paired
  double log_odds = 0;  ///< against "all clutter", \cite algorithm eq. (5.10)
  /// Expected number of hypotheses with this support by chance among all bases retrieved. Below
  /// `GeneratorOptions::significance` the hypothesis is significant. \cite algorithm eq. (5.12)
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
