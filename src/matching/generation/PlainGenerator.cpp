// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/generation/PlainGenerator.h"

#include "matching/generation/sampling.h"
#include "signature/unary_constraint.h"

#include <algorithm>

namespace sigloc
{
void gatherCandidates(FeatureQuery& query, const PairLists& lists, const FeaturePairing& anchor,
                      std::uint32_t j, std::vector<std::uint32_t>& candidates)
{
  const PreparedMap& map = query.map;
  const BinaryGates& gates = query.gates;
  const MapErrorModel& error = map.map().error();
  const DirectedFeature& first = query.scene.views[anchor.observed];
  const DirectedFeature& second = query.scene.views[j];
  const BinaryKey key = binaryKey(first, second);
  const double tolerance =
      keyTolerance(key, lists.largestKeyVariance(first.type(), second.type()), error, gates.scalar);
  candidates.clear();
  query.counters.visits += lists.visit(
      anchor.mapped, key, second.type(), tolerance,
      [&](std::uint32_t l)
      {
        if (unaryCompatible(second, map.view(l), gates.scalar) &&
            binaryCompatible(first, second, map.view(anchor.mapped), map.view(l), error, gates))
        {
          candidates.push_back(l);
        }
      });
}

std::vector<FeatureHypothesis> PlainGenerator::generate(const std::vector<Feature>& observed,
                                                        MatchingCounters& counters) const
{
  FeatureQuery query(observed, *verifier_, counters);
  const bool complete = search(query);
  std::vector<FeatureHypothesis> ranked = query.ranked(2, query.bases());
  if (complete) return ranked;
  ++counters.cut_short;
  // An equal of the best may be where nothing was compared.
  for (FeatureHypothesis& hypothesis : ranked) hypothesis.chance = std::max(1.0, hypothesis.chance);
  return ranked;
}

/// Returns whether it ended within the budget.
bool PlainGenerator::search(FeatureQuery& query) const
{
  const PreparedScene& scene = query.scene;
  const PreparedMap& map = query.map;
  MatchingCounters& counters = query.counters;
  const auto n = static_cast<std::uint32_t>(scene.size());
  const auto m = static_cast<std::uint32_t>(map.size());
  const std::uint32_t needed = std::min(query.options.min_support, n);
  CandidateLists candidates(n);
  const std::uint64_t end = counters.checks + counters.visits + query.options.plain_operations;

  for (std::uint32_t i = 0; i < n; ++i)
  {
    for (std::uint32_t k = 0; k < m; ++k)
    {
      ++counters.visits;
      if (!unaryCompatible(scene.views[i], map.view(k), query.gates.scalar)) continue;
      ++counters.signature_pairs;

      // L_j(i, k) for every other observed feature, and the largest support that they allow.
      std::uint32_t possible = 1;
      for (std::uint32_t j = 0; j < n; ++j)
      {
        candidates[j].clear();
        if (j == i) continue;
        gatherCandidates(query, *lists_, {i, k}, j, candidates[j]);
        if (!candidates[j].empty()) ++possible;
      }
      if (counters.checks + counters.visits > end) return false;
      if (possible < needed) continue;

      // Every second pairing gives a pose, which the other lists must support.
      for (std::uint32_t j = 0; j < n; ++j)
      {
        for (const std::uint32_t l : candidates[j])
        {
          if (!verifier_->makeBase(query, {i, k}, {j, l})) continue;
          verifier_->verify(query, &candidates);
          if (counters.checks + counters.visits > end) return false;
        }
      }
    }
  }
  return true;
}
}  // namespace sigloc
