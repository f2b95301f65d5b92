// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "eval/methods/features/FeatureOpponent.h"

namespace sigloc
{
struct JcbbOptions
{
  double good_share = 0.5;  ///< P_good, the share of what is seen that is mapped, before any search
  bool greedy = false;  ///< pair the rest with nearest neighbours in place of branch and bound
};

/// The opponent for landmark maps: relocation by random sampling with locality, after Neira, Tardos
/// and Castellanos (2003). Draws p = 4 observed features. Each map feature is tried as the first
/// pairing. The others are searched by unary and binary constraints in its locality, without a star
/// branch. A full set that passes the joint chi-square test gives a pose. The other features are
/// then paired by joint compatibility branch and bound. \cite Neira, Tardos, "Data association in
/// stochastic mapping using the joint compatibility test" (2001). The number of draws follows
/// P_good, P_fail = 0.05 and the best so far.
class JcbbRelocation : public FeatureOpponent
{
 public:
  /// Keeps a reference to the map. `budget` is that of FeatureOpponent.
  JcbbRelocation(const FeatureMap& map, const GeneratorOptions& options,
                 const JcbbOptions& jcbb = {}, std::uint64_t budget = kBudget);

 private:
  struct Draw;
  struct Completion;
  void search(Query& query) const override;
  std::uint32_t baseSize() const override;
  void extend(Query& query, Draw& draw, std::size_t level) const;
  void complete(Query& query, const Draw& draw) const;
  /// The pairings that one more observed feature may have at the base's pose, nearest first.
  std::vector<std::uint32_t> compatible(Query& query, const Completion& completion,
                                        const FeaturePairing& anchor, std::uint32_t observed) const;
  void branch(Query& query, Completion& completion, std::size_t level) const;

  JcbbOptions jcbb_;
};
}  // namespace sigloc
