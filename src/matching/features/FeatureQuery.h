// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/features/FeatureVerifier.h"
#include "matching/features/HypothesisSet.h"

#include <cstdint>
#include <vector>

namespace sigloc
{
/// One search by features alone: what was observed, the map that it is sought in, what was found so
/// far, and what that cost. Keeps references to all that it is made from.
struct FeatureQuery
{
  FeatureQuery(const std::vector<Feature>& features, const FeatureVerifier& verifier,
               MatchingCounters& counted_in);

  /// The same for a search that verifies by itself.
  FeatureQuery(const std::vector<Feature>& features, const PreparedMap& in_map,
               const GeneratorOptions& search_options, const BinaryGates& search_gates,
               MatchingCounters& counted_in);

  /// The features must outlive the query.
  FeatureQuery(std::vector<Feature>&&, const FeatureVerifier&, MatchingCounters&) = delete;
  FeatureQuery(std::vector<Feature>&&, const PreparedMap&, const GeneratorOptions&,
               const BinaryGates&, MatchingCounters&) = delete;

  /// Returns how many bases were retrieved since the query began.
  std::uint64_t bases() const { return counters.hypotheses - hypotheses_before; }

  /// Returns the expected number of hypotheses with this support by chance among `bases` retrieved,
  /// each of `base_size` features. \cite algorithm eq. (5.12)
  double expectedByChance(std::uint32_t support, std::uint32_t base_size,
                          std::uint64_t bases) const;

  /// True when the best hypothesis so far is hardly one by chance among these bases.
  bool isSignificant(std::uint32_t base_size, std::uint64_t bases) const;

  /// Returns the best hypotheses found, with the expected number of equally good ones by chance.
  std::vector<FeatureHypothesis> ranked(std::uint32_t base_size, std::uint64_t bases) const;

  const std::vector<Feature>& observed;
  const PreparedMap& map;
  const GeneratorOptions& options;
  const BinaryGates& gates;
  MatchingCounters& counters;
  std::uint64_t hypotheses_before;  ///< counted when the query began
  PreparedScene scene;
  HypothesisSet found;
  FeatureVerifier::Workspace workspace;
};
}  // namespace sigloc
