// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/features/Feature.h"
#include "sigloc/geometry/GaussianPose.h"

#include <cstdint>
#include <vector>

namespace sigloc
{
/// Observed feature `observed` is taken to be map feature `mapped` (indices).
struct FeaturePairing
{
  std::uint32_t observed = 0;
  std::uint32_t mapped = 0;
};

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

/// What generating and verifying cost, in operations; times never enter results.
struct MatchingCounters
{
  std::uint64_t signature_pairs = 0;  ///< (observed, mapped) signatures compared
  std::uint64_t hypotheses = 0;  ///< base pairings turned into a pose
  std::uint64_t checks = 0;  ///< location-dependent checks of a pairing at a pose
  std::uint64_t poses_scored = 0;  ///< poses looked up in the dense field
  std::uint64_t cut_short = 0;  ///< searches that ended at their budget, unfinished
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
