// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/matching/sampling.h"

#include <algorithm>
#include <cmath>

namespace sigloc
{
std::uint32_t drawsNeeded(double failure, double success)
{
  if (success >= 1) return 1;
  return static_cast<std::uint32_t>(std::ceil(std::log(failure) / std::log1p(-success)));
}

std::vector<std::uint32_t> observedOf(const FeatureHypothesis& hypothesis)
{
  std::vector<std::uint32_t> observed;
  for (const FeaturePairing& pairing : hypothesis.pairings) observed.push_back(pairing.observed);
  std::sort(observed.begin(), observed.end());
  return observed;
}

std::vector<FeatureHypothesis> rankedHypotheses(const PreparedScene& scene,
                                                const FeatureVerifier& verifier,
                                                const HypothesisSet& found, std::uint32_t base_size,
                                                std::uint64_t bases)
{
  std::vector<FeatureHypothesis> ranked = found.ranked(verifier.options().max_hypotheses);
  for (FeatureHypothesis& hypothesis : ranked)
  {
    hypothesis.chance =
        FeatureVerifier::expectedByChance(scene, hypothesis.support, base_size, bases);
  }
  return ranked;
}

}  // namespace sigloc
