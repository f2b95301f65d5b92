// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/features/InterpretationTree.h"

#include <algorithm>

namespace sigloc
{
struct InterpretationTree::Branch
{
  std::vector<FeaturePairing> pairings;
  std::size_t most = 0;  ///< pairings of the best leaf so far, at first the fewest that count
};

void InterpretationTree::judgeLeaf(Query& query, Branch& branch) const
{
  ++query.counters.hypotheses;
  const auto whole = fit(query, branch.pairings);
  if (!whole || !jointlyCompatible(whole->distance, whole->degrees)) return;
  branch.most = std::max(branch.most, branch.pairings.size());
  add(query, branch.pairings, *whole);
}

void InterpretationTree::descend(Query& query, Branch& branch, std::uint32_t level) const
{
  const auto n = static_cast<std::uint32_t>(query.scene.size());
  if (branch.pairings.size() + (n - level) < branch.most || query.exhausted()) return;
  if (level == n) return judgeLeaf(query, branch);

  const auto follow = [&](std::uint32_t l)
  {
    branch.pairings.push_back({level, l});
    descend(query, branch, level + 1);
    branch.pairings.pop_back();
  };
  if (branch.pairings.empty())
  {
    for (std::uint32_t k = 0; k < map().size() && !query.exhausted(); ++k)
    {
      if (unary(query, level, k)) follow(k);
    }
  }
  else
  {
    // The first pairing's constraints are sorted, so the features that they exclude are never
    // visited.
    std::vector<std::uint32_t> candidates;
    gather(query, branch.pairings.front(), level, candidates);
    for (const std::uint32_t l : candidates)
    {
      const bool fits = std::all_of(branch.pairings.begin() + 1, branch.pairings.end(),
                                    [&](const FeaturePairing& pairing) {
                                      return binary(query, pairing, {level, l});
                                    });
      if (fits) follow(l);
    }
  }
  descend(query, branch, level + 1);  // the star: this feature is nothing mapped
}

void InterpretationTree::search(Query& query) const
{
  Branch branch;
  branch.most = std::min<std::size_t>(options().min_support, query.scene.size());
  descend(query, branch, 0);
}
}  // namespace sigloc
