// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/features/FeatureVerifier.h"
#include "matching/generation/PairIndex.h"

namespace sigloc
{
/// Mode (c): observed pairs, rare and long ones first, looked up in an index of all mapped pairs.
/// Ends with the first significant answer, after a second look for places that look alike.
class PairIndexGenerator : public FeatureHypothesisGenerator
{
 public:
  PairIndexGenerator(std::shared_ptr<const FeatureVerifier> verifier,
                     std::shared_ptr<const PairLists> lists);

  std::vector<FeatureHypothesis> generate(const std::vector<Feature>& observed,
                                          MatchingCounters& counters) const override;

  /// The search itself, adding to `found`, within a budget of hypotheses.
  void search(const PreparedScene& scene, HypothesisSet& found,
              FeatureVerifier::Workspace& workspace, MatchingCounters& counters,
              std::uint64_t budget) const;

  /// Searches with pairs of what the best hypothesis explains for places that explain nearly as
  /// much, eq. (4.4). Not at all where that could take more than `budget` bases.
  void lookAgain(const PreparedScene& scene, HypothesisSet& found,
                 FeatureVerifier::Workspace& workspace, MatchingCounters& counters,
                 std::uint64_t budget) const;

  /// How many bases a search would retrieve at most, without retrieving them.
  std::uint64_t basesFor(const PreparedScene& scene) const;

 private:
  struct Lookup;
  std::vector<Lookup> lookupsOfAll(const PreparedScene& scene) const;
  std::vector<Lookup> lookupsOfExplained(const PreparedScene& scene,
                                         const HypothesisSet& found) const;
  static std::uint64_t basesOf(const std::vector<Lookup>& lookups);
  std::vector<Lookup> rankedLookups(const PreparedScene& scene,
                                    const std::vector<std::uint32_t>& among,
                                    std::uint32_t count) const;
  void tryLookup(const PreparedScene& scene, const Lookup& lookup, HypothesisSet& found,
                 FeatureVerifier::Workspace& workspace, MatchingCounters& counters,
                 std::uint64_t budget) const;

  std::shared_ptr<const FeatureVerifier> verifier_;
  std::shared_ptr<const PairLists> lists_;
  PairIndex index_;
};
}  // namespace sigloc
