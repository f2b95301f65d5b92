// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "matching/generation/pattern_order.h"
#include "matching/generation/PatternGenerator.h"

namespace sigloc
{
/// A query with its random numbers, the pattern drawn last, and buffers.
struct PatternGenerator::Query : FeatureQuery
{
  Query(const std::vector<Feature>& features, const FeatureVerifier& verifier,
        MatchingCounters& counted_in)
      : FeatureQuery(features, verifier, counted_in), random(options.seed)
  {
  }

  SplitMix random;
  PatternMembers members{};
  double map_variance = 0;  ///< [m^2], of a mapped place, each coordinate
  double variance = 0;  ///< [m^2], of a member against its mapped place, each coordinate
  PatternIndex::Gate gate;
  std::vector<std::uint32_t> near;
  std::vector<PatternOrder> orders;
  std::vector<std::uint64_t> tried;  ///< keys of the patterns drawn so far
  std::uint64_t pair_bases = 0;  ///< pairs tried for look-alikes only
  std::vector<std::uint32_t>
      partners;  ///< of each feature at the pose whose look-alikes are sought
  std::vector<const std::uint32_t*> hits;
  std::vector<PoseEstimate> poses;
};
}  // namespace sigloc
