// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/matching/FeatureVerifier.h"
#include "sigloc/matching/PairLists.h"

namespace sigloc
{
/// The opponent for landmark maps: relocation by random sampling with locality, a variant of Neira,
/// Tardos and Castellanos (2003). Draws p = 4 observed features; with each map feature as the first
/// pairing, the others are sought by unary and binary constraints in its locality, without a star
/// branch; a full set gives a pose, which is completed by nearest neighbours and joint
/// compatibility. The number of draws follows P_good = 0.5, P_fail = 0.05 and the best so far.
class JcbbRelocation : public FeatureHypothesisGenerator
{
 public:
  JcbbRelocation(const FeatureMap& map, const GeneratorOptions& options);

  std::vector<FeatureHypothesis> generate(const std::vector<Feature>& observed,
                                          MatchingCounters& counters) const override;

 private:
  struct Search;
  void extend(Search& search, std::size_t level) const;

  std::shared_ptr<const PreparedMap> map_;
  FeatureVerifier verifier_;
  PairLists lists_;
};
}  // namespace sigloc
