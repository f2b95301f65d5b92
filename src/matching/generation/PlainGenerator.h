// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/features/FeatureQuery.h"
#include "matching/features/PairLists.h"

namespace sigloc
{
/// Mode (a): compares every observed signature with every mapped one. It is complete and the
/// reference for all others; it takes O(n^3 m c^2) checks. Where that is more than its budget, it
/// is cut short, and nothing that it found is significant. \cite algorithm section 4 (a)
class PlainGenerator : public FeatureHypothesisGenerator
{
 public:
  /// Uncut lists hold every pair: those of larger maps would take 0.8 GB and more.
  static constexpr std::size_t kMostFeatures = 10'000;

  /// The lists should be uncut: with a cut-off, pairs farther apart are never a base.
  PlainGenerator(std::shared_ptr<const FeatureVerifier> verifier,
                 std::shared_ptr<const PairLists> lists)
      : verifier_(std::move(verifier)), lists_(std::move(lists))
  {
  }

  std::vector<FeatureHypothesis> generate(const std::vector<Feature>& observed,
                                          MatchingCounters& counters) const override;

 private:
  bool search(FeatureQuery& query) const;

  std::shared_ptr<const FeatureVerifier> verifier_;
  std::shared_ptr<const PairLists> lists_;
};

/// Returns the map features that observed feature j may be if observed i is mapped k: L_j(i, k),
/// by its unary and binary constraints. The entries read count as visits.
/// \cite algorithm eq. (4.1)
void gatherCandidates(FeatureQuery& query, const PairLists& lists, const FeaturePairing& anchor,
                      std::uint32_t j, std::vector<std::uint32_t>& candidates);
}  // namespace sigloc
