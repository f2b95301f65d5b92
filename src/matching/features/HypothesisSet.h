// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/same_place.h"
#include "matching/features/FeatureHypothesis.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace sigloc
{
/// The verified hypotheses of one query. A hash grid of poses finds equal poses, of which the best
/// stays. \cite algorithm eq. (5.13)
class HypothesisSet
{
 public:
  explicit HypothesisSet(std::size_t observed_count) : observed_count_(observed_count) {}

  /// Adds a hypothesis unless there is a better one within 0.5 m and 17 degrees.
  void add(FeatureHypothesis hypothesis);

  /// True when a hypothesis already has both pairings, so that the base need not be verified.
  bool explains(const FeaturePairing& first, const FeaturePairing& second) const;

  std::uint32_t bestSupport() const { return best_support_; }
  /// The best so far by log-odds, or nullptr.
  const FeatureHypothesis* best() const;

  /// Returns the best `count` distinct hypotheses, best first. Ties are ordered by the pose.
  std::vector<FeatureHypothesis> ranked(std::size_t count) const;

 private:
  struct Item
  {
    FeatureHypothesis hypothesis;
    std::vector<std::uint32_t> mapped_of;  ///< by observed feature
  };
  void prune();
  void enterCells(std::uint32_t index);

  std::size_t observed_count_;
  std::vector<Item> items_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
  std::vector<std::uint64_t> pairing_bits_ = std::vector<std::uint64_t>(256, 0);
  std::uint32_t best_support_ = 0;
};
}  // namespace sigloc
