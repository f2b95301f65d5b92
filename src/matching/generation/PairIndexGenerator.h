// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/features/FeatureQuery.h"
#include "matching/generation/PairIndex.h"

namespace sigloc
{
/// Mode (c): finds observed pairs, rare and long ones first, in an index of all mapped pairs. The
/// first significant answer ends the search, after a second round for look-alike poses.
/// \cite algorithm section 4 (c)
class PairIndexGenerator : public FeatureHypothesisGenerator
{
 public:
  PairIndexGenerator(std::shared_ptr<const FeatureVerifier> verifier,
                     std::shared_ptr<const PairLists> lists);

  std::vector<FeatureHypothesis> generate(const std::vector<Feature>& observed,
                                          MatchingCounters& counters) const override;

  /// Adds what it finds to the query, within a budget of hypotheses.
  void search(FeatureQuery& query, std::uint64_t budget) const;

  /// Searches for poses that explain nearly as much as the best hypothesis, with pairs of the
  /// features that it explains, eq. (4.4). Does nothing where that could take more than `budget`
  /// bases.
  void searchAgain(FeatureQuery& query, std::uint64_t budget) const;

  /// Returns how many bases a search would retrieve at most, without retrieving them.
  std::uint64_t basesFor(const PreparedScene& scene) const;

 private:
  struct Lookup;
  std::vector<Lookup> lookupsOfAll(const PreparedScene& scene) const;
  std::vector<Lookup> lookupsOfExplained(const FeatureQuery& query) const;
  static std::uint64_t basesOf(const std::vector<Lookup>& lookups);
  std::vector<Lookup> lookupsAmong(const PreparedScene& scene,
                                   const std::vector<std::uint32_t>& among) const;
  static std::vector<Lookup> longerHalf(std::vector<Lookup> lookups, std::size_t count);
  static std::vector<Lookup> fairChoice(std::vector<Lookup> lookups, std::size_t features,
                                        std::size_t fair);
  std::vector<Lookup> rankedLookups(const PreparedScene& scene,
                                    const std::vector<std::uint32_t>& among,
                                    std::uint32_t count) const;
  void tryLookup(FeatureQuery& query, const Lookup& lookup, std::uint64_t limit) const;

  std::shared_ptr<const FeatureVerifier> verifier_;
  std::shared_ptr<const PairLists> lists_;
  PairIndex index_;
};
}  // namespace sigloc
