// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/features/FeatureQuery.h"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>

namespace sigloc
{
FeatureQuery::FeatureQuery(const std::vector<Feature>& features, const FeatureVerifier& verifier,
                           MatchingCounters& counted_in)
    : FeatureQuery(features, verifier.map(), verifier.options(), verifier.gates(), counted_in)
{
}

FeatureQuery::FeatureQuery(const std::vector<Feature>& features, const PreparedMap& in_map,
                           const GeneratorOptions& search_options, const BinaryGates& search_gates,
                           MatchingCounters& counted_in)
    : observed(features),
      map(in_map),
      options(search_options),
      gates(search_gates),
      counters(counted_in),
      hypotheses_before(counters.hypotheses),
      scene(observed, map, options, gates),
      found(scene.size())
{
}

double FeatureQuery::expectedByChance(std::uint32_t support, std::uint32_t base_size,
                                      std::uint64_t bases) const
{
  const auto n = static_cast<double>(scene.size());
  const double trials = n - base_size;
  const double needed = static_cast<double>(support) - base_size;
  const double retrieved = static_cast<double>(std::max<std::uint64_t>(1, bases));
  if (needed <= 0 || trials <= 0) return retrieved;
  if (needed > trials) return 0;
  // The upper tail of the binomial distribution is an incomplete beta function.
  return retrieved *
         boost::math::ibeta(needed, trials - needed + 1, std::min(1.0, scene.mean_chance));
}

bool FeatureQuery::isSignificant(std::uint32_t base_size, std::uint64_t bases) const
{
  const FeatureHypothesis* best = found.best();
  return best && expectedByChance(best->support, base_size, bases) < options.significance;
}

std::vector<FeatureHypothesis> FeatureQuery::ranked(std::uint32_t base_size,
                                                    std::uint64_t bases) const
{
  std::vector<FeatureHypothesis> ranked = found.ranked(options.max_hypotheses);
  for (FeatureHypothesis& hypothesis : ranked)
  {
    hypothesis.chance = expectedByChance(hypothesis.support, base_size, bases);
  }
  return ranked;
}
}  // namespace sigloc
