// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/features/FeatureQuery.h"
#include "matching/features/PairLists.h"

namespace sigloc
{
/// Mode (b): compares a fixed number of random observed anchors, each with a few random partners,
/// with the whole map. Linear in the map and in the number of observed features.
/// \cite algorithm eq. (4.2), (4.3)
class AnchorGenerator : public FeatureHypothesisGenerator
{
 public:
  AnchorGenerator(std::shared_ptr<const FeatureVerifier> verifier,
                  std::shared_ptr<const PairLists> lists)
      : verifier_(std::move(verifier)), lists_(std::move(lists))
  {
  }

  std::vector<FeatureHypothesis> generate(const std::vector<Feature>& observed,
                                          MatchingCounters& counters) const override;

  /// Adds what it finds to the query, within a budget of hypotheses.
  void search(FeatureQuery& query, std::uint64_t budget) const;

 private:
  std::shared_ptr<const FeatureVerifier> verifier_;
  std::shared_ptr<const PairLists> lists_;
};
}  // namespace sigloc
