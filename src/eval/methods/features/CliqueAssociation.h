// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eval/methods/features/FeatureOpponent.h"

namespace sigloc
{
/// Combined constraint data association after Bailey. The nodes of the correspondence graph are
/// unary-compatible pairings. Its edges join pairings that are compatible by their binary
/// constraints. The answer is its maximum clique. Finds all largest cliques with Boost's
/// Bron-Kerbosch, one neighbourhood after the other. A clique pairs each observed feature once. So
/// it is found from its pairing of the first of them, among the pairings that are compatible with
/// that one.
class CliqueAssociation : public FeatureOpponent
{
 public:
  using FeatureOpponent::FeatureOpponent;

 private:
  struct Neighbourhood;
  void search(Query& query) const override;
  std::uint32_t baseSize() const override { return 2; }
  void gatherNeighbourhood(Query& query, const FeaturePairing& first,
                           Neighbourhood& neighbourhood) const;
  void searchCliques(Query& query, const FeaturePairing& first, Neighbourhood& neighbourhood,
                     std::size_t& most) const;
};
}  // namespace sigloc
