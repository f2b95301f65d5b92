// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/features/SplitMix.h"
#include "matching/generation/AnchorGenerator.h"
#include "matching/generation/PairIndexGenerator.h"
#include "matching/generation/PatternIndex.h"

namespace sigloc
{
/// Mode (d): finds observed patterns of three to five places in a hash of all mapped patterns. The
/// number of patterns found hardly grows with the map. Falls back to pairs, then to anchors, when
/// no answer is significant and theirs could be. \cite algorithm section 4 (d)
class PatternGenerator : public FeatureHypothesisGenerator
{
 public:
  PatternGenerator(std::shared_ptr<const FeatureVerifier> verifier,
                   std::shared_ptr<const PairLists> lists);

  std::vector<FeatureHypothesis> generate(const std::vector<Feature>& observed,
                                          MatchingCounters& counters) const override;

 private:
  struct Query;
  bool drawPattern(const std::vector<bool>& among, std::uint32_t root, std::size_t most_orders,
                   Query& query) const;
  void gatePattern(Query& query) const;
  void tryPattern(Query& query) const;
  bool fitPattern(const Query& query, const PatternMembers& observed, const std::uint32_t* mapped,
                  PoseEstimate& pose) const;
  bool mayJoin(const Query& query, std::uint32_t root, std::uint32_t member) const;
  bool leadsToPartners(const Query& query, const PatternMembers& observed,
                       const std::uint32_t* mapped) const;
  template <class Done>
  std::uint32_t draw(const std::vector<std::uint32_t>& roots, std::uint32_t wanted, Query& query,
                     const Done& done) const;
  bool search(Query& query) const;
  void searchAgain(Query& query) const;
  bool smallerBasesMayHelp(const Query& query) const;
  double shareOfPatterns(const PreparedScene& scene, std::uint32_t support) const;

  std::shared_ptr<const FeatureVerifier> verifier_;
  PatternIndex index_;
  double residual_gate_;  ///< chi-square gate on the residuals of a pattern, eq. (4.7)
  PairIndexGenerator pairs_;
  AnchorGenerator anchors_;
};
}  // namespace sigloc
