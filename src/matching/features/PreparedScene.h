// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/features/FeatureHypothesis.h"
#include "matching/features/GeneratorOptions.h"
#include "matching/features/PreparedMap.h"
#include "signature/binary_constraint.h"

#include <cstdint>
#include <vector>

namespace sigloc
{
/// What all modes need of the observed features, computed once a query. Keeps references to the
/// features, which must outlive it.
struct PreparedScene
{
  PreparedScene(const std::vector<Feature>& observed, const PreparedMap& map,
                const GeneratorOptions& options, const BinaryGates& gates);

  std::size_t size() const { return views.size(); }

  /// Returns all indices by distance from feature i, nearest (i itself) first. Derived features
  /// come last, because they count only where their walls are not paired.
  const std::uint32_t* orderFrom(std::size_t i) const { return &order[i * views.size()]; }

  std::vector<DirectedFeature> views;
  std::vector<std::uint32_t> order;
  std::vector<double> chance;  ///< p_i: probability that a wrong pose finds a match for feature i
  std::vector<double> hit_gain;  ///< ln(w / p_i), log-odds of a match, eq. (5.7)
  std::vector<double> miss_gain;  ///< ln((1 - w) / (1 - p_i)), log-odds of a miss, eq. (5.7)
  double mean_chance = 0;  ///< mean of p_i, p of eq. (5.12)
  double relative_sigma = 0;  ///< [m], the map's relative error over the scene's mean range
};

/// True where a wall is among the observed features.
bool seesWalls(const std::vector<Feature>& observed);

/// Returns false for a corner or wall end if the wall that it was derived from is paired, because
/// both come from the same beams. Only the observed feature of `pairing` is used.
bool counts(const PreparedScene& scene, const FeaturePairing& pairing,
            const std::vector<FeaturePairing>& pairings);
}  // namespace sigloc
