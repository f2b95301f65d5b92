// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace sigloc
{
/// How hypotheses are generated and verified by features alone: modes (a) to (d).
/// \cite algorithm sections 4 and 5
struct GeneratorOptions
{
  double gate_probability = 0.995;  ///< share of right pairings that pass a gate
  /// P_fail: chance that sampling misses a pose of good_share support.
  double failure_probability = 0.01;
  double good_share = 0.5;  ///< w: share of the observed features that really are in the map
  std::uint32_t partners = 3;  ///< s: partners tried with an anchor
  double detection_probability = 0.8;  ///< P_D: chance that a mapped feature in view is observed
  double min_overlap = 0.5;  ///< share of an observed wall that must lie on the mapped one
  std::uint32_t min_support = 3;  ///< fewest pairings of a hypothesis
  /// Hypotheses as good expected by chance, below which one is significant.
  double significance = 0.001;
  std::uint32_t max_hypotheses = 50;  ///< how many hypotheses are returned at most
  std::uint32_t max_neighbours = 48;  ///< mean number of neighbours a feature is indexed with
  std::uint32_t pattern_size = 0;  ///< features of an indexed pattern, 3 to 5; 0: grows with log m
  std::uint32_t max_patterns = 24;  ///< mean number of patterns a feature is indexed with
  /// Budget of pairs and of anchors each, when patterns find nothing.
  std::uint32_t fall_back_hypotheses = 400000;
  /// Budget of mode (a): checks, and cells and list entries read.
  std::uint64_t plain_operations = 1'000'000'000;
  std::uint32_t seed = 1;  ///< of the sampling
};
}  // namespace sigloc
