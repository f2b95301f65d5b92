// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/generation/AnchorGenerator.h"

#include "matching/features/SplitMix.h"
#include "matching/generation/PlainGenerator.h"
#include "matching/generation/sampling.h"
#include "signature/unary_constraint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sigloc
{
namespace
{
/// Returns random partners of an anchor, from the farther half of the features within the cut-off.
/// A long base gives a good heading.
std::vector<std::uint32_t> drawPartners(const PreparedScene& scene, std::uint32_t anchor,
                                        double cut_off, std::uint32_t count, SplitMix& random)
{
  const auto distance = [&](std::uint32_t j)
  {
    const auto between = scene.views[j].position() - scene.views[anchor].position();
    return std::hypot(between.x, between.y);
  };
  std::vector<std::uint32_t> others;
  for (std::uint32_t j = 0; j < scene.size(); ++j)
  {
    if (j != anchor && distance(j) < cut_off) others.push_back(j);
  }
  std::sort(others.begin(), others.end(),
            [&](std::uint32_t a, std::uint32_t b)
            { return distance(a) != distance(b) ? distance(a) > distance(b) : a < b; });
  others.resize(std::min<std::size_t>(others.size(),
                                      std::max<std::size_t>(2 * count, (others.size() + 1) / 2)));
  random.shuffle(others);
  others.resize(std::min<std::size_t>(others.size(), count));
  return others;
}
}  // namespace

void AnchorGenerator::search(FeatureQuery& query, std::uint64_t budget) const
{
  const PreparedScene& scene = query.scene;
  const GeneratorOptions& options = query.options;
  const auto n = static_cast<std::uint32_t>(scene.size());
  const std::uint64_t before = query.bases();
  std::vector<std::uint32_t> candidates;
  SplitMix random(options.seed);

  // 1. The number of anchors: eq. (4.2), (4.3). It is not reduced as support is found, because
  // accidental support would stop the search too early, and all plausible poses are wanted.
  const double w = options.good_share;
  const double works = w * (1 - std::pow(1 - w, options.partners));
  const std::uint32_t draws = std::min(n, drawsNeeded(options.failure_probability, works));
  std::vector<std::uint32_t> anchors(n);
  std::iota(anchors.begin(), anchors.end(), 0U);
  random.shuffle(anchors);
  anchors.resize(draws);

  for (const std::uint32_t i : anchors)
  {
    // 2. A few distant partners for each.
    const auto partners = drawPartners(scene, i, lists_->cutOff(), options.partners, random);
    for (std::uint32_t k = 0; k < query.map.size(); ++k)
    {
      ++query.counters.visits;
      if (!unaryCompatible(scene.views[i], query.map.view(k), query.gates.scalar)) continue;
      ++query.counters.signature_pairs;
      if (query.bases() - before >= budget) return;
      for (const std::uint32_t j : partners)
      {
        // 3. Every l in L_j(i, k) makes a base, verified over all observed features.
        gatherCandidates(query, *lists_, {i, k}, j, candidates);
        for (const std::uint32_t l : candidates)
        {
          if (verifier_->makeBase(query, {i, k}, {j, l})) verifier_->verify(query);
        }
      }
    }
  }
}

std::vector<FeatureHypothesis> AnchorGenerator::generate(const std::vector<Feature>& observed,
                                                         MatchingCounters& counters) const
{
  FeatureQuery query(observed, *verifier_, counters);
  search(query, std::numeric_limits<std::uint64_t>::max());
  return query.ranked(2, query.bases());
}
}  // namespace sigloc
