// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/generation/PlainGenerator.h"

#include "matching/features/sampling.h"
#include "signature/unary_constraint.h"

#include <algorithm>

namespace sigloc
{
void gatherCandidates(const PreparedScene& scene, const PreparedMap& map, const BinaryGates& gates,
                      const PairLists& lists, const FeaturePairing& anchor, std::uint32_t j,
                      std::vector<std::uint32_t>& candidates, MatchingCounters& counters)
{
  const MapErrorModel& error = map.map().error();
  const DirectedFeature& first = scene.views[anchor.observed];
  const DirectedFeature& second = scene.views[j];
  const BinaryKey key = binaryKey(first, second);
  const double tolerance =
      keyTolerance(key, lists.largestKeyVariance(first.type(), second.type()), error, gates.scalar);
  candidates.clear();
  counters.visits += lists.visit(
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
  const PreparedScene scene(observed, verifier_->map(), verifier_->options(), verifier_->gates());
  HypothesisSet found(scene.size());
  const std::uint64_t before = counters.hypotheses;
  const bool complete = search(scene, found, counters);
  std::vector<FeatureHypothesis> ranked =
      rankedHypotheses(scene, *verifier_, found, 2, counters.hypotheses - before);
  if (complete) return ranked;
  ++counters.cut_short;
  // An equal of the best may be where nothing was compared.
  for (FeatureHypothesis& hypothesis : ranked) hypothesis.chance = std::max(1.0, hypothesis.chance);
  return ranked;
}

/// Returns whether it ended within the budget.
bool PlainGenerator::search(const PreparedScene& scene, HypothesisSet& found,
                            MatchingCounters& counters) const
{
  const PreparedMap& map = verifier_->map();
  const auto n = static_cast<std::uint32_t>(scene.size());
  const auto m = static_cast<std::uint32_t>(map.size());
  const std::uint32_t needed = std::min(verifier_->options().min_support, n);
  FeatureVerifier::Workspace workspace;
  CandidateLists candidates(n);
  const std::uint64_t end =
      counters.checks + counters.visits + verifier_->options().plain_operations;

  for (std::uint32_t i = 0; i < n; ++i)
  {
    for (std::uint32_t k = 0; k < m; ++k)
    {
      ++counters.visits;
      if (!unaryCompatible(scene.views[i], map.view(k), verifier_->gates().scalar)) continue;
      ++counters.signature_pairs;

      // L_j(i, k) for every other observed feature, and the largest support that they allow.
      std::uint32_t possible = 1;
      for (std::uint32_t j = 0; j < n; ++j)
      {
        candidates[j].clear();
        if (j == i) continue;
        gatherCandidates(scene, map, verifier_->gates(), *lists_, {i, k}, j, candidates[j],
                         counters);
        if (!candidates[j].empty()) ++possible;
      }
      if (counters.checks + counters.visits > end) return false;
      if (possible < needed) continue;

      // Every second pairing gives a pose, which the other lists must support.
      for (std::uint32_t j = 0; j < n; ++j)
      {
        for (const std::uint32_t l : candidates[j])
        {
          if (!verifier_->makeBase(scene, {i, k}, {j, l}, workspace.base, counters)) continue;
          verifier_->verify(scene, &candidates, found, workspace, counters);
          if (counters.checks + counters.visits > end) return false;
        }
      }
    }
  }
  return true;
}
}  // namespace sigloc
