// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eval/methods/features/FeatureOpponent.h"

namespace sigloc
{
/// Combined constraint data association after Bailey: the nodes of the correspondence graph are
/// unary-compatible pairings, its edges join pairings that are compatible by their binary
/// constraints, and the answer is its maximum clique. Finds all largest cliques with Boost's
/// Bron-Kerbosch, one neighbourhood after the other: a clique pairs each observed feature once,
/// so it is found from its pairing of the first of them, among what that one leaves possible.
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
