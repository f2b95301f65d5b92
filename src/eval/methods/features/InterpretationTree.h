// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eval/methods/features/FeatureOpponent.h"

namespace sigloc
{
/// Grimson's interpretation tree. Each observed feature has a level, with a branch for every map
/// feature it may be and one for "none of them" (the star). A branch is cut by unary and binary
/// constraints, and when it can't reach the most pairings found so far. A leaf counts when its
/// pairings are jointly compatible. Finds every largest interpretation. The time is exponential in
/// the number of observed features that fit nothing; the budget limits it.
class InterpretationTree : public FeatureOpponent
{
 public:
  using FeatureOpponent::FeatureOpponent;

 private:
  struct Branch;
  void search(Query& query) const override;
  std::uint32_t baseSize() const override { return 2; }
  void descend(Query& query, Branch& branch, std::uint32_t level) const;
  void judgeLeaf(Query& query, Branch& branch) const;
};
}  // namespace sigloc
