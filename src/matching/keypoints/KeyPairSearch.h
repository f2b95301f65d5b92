// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/NearPlaces.h"
#include "matching/dense/DenseEvidence.h"
#include "matching/keypoints/KeyPairIndex.h"
#include "sigloc/matching/RelocationResult.h"

namespace sigloc
{
/// Proposes poses for one scene from its pairs of key points, those with the fewest mapped partners
/// first. \cite algorithm section 4 (f)
class KeyPairSearch
{
 public:
  /// Counts the partners of each observed pair. The index must outlive the search.
  KeyPairSearch(const KeyPairIndex& index, const std::vector<Feature>& observed);

  /// Proposes by the next pairs until there are `wanted` proposals in all, and returns the new
  /// ones. None are left when it returns an empty list.
  std::vector<PoseProposal> next(std::size_t wanted);

  /// Returns how many observed pairs support a pose: have proposed one within 0.4 m and 0.12 rad.
  std::size_t supportersOf(const mrpt::math::TPose2D& pose) const;

  /// Returns whether any pose proposed so far is supported by that many pairs.
  bool anySupportedBy(std::size_t pairs);

  /// True when every pair with a mapped partner has proposed its poses.
  bool finished() const { return next_ == pairs_.size(); }
  std::uint64_t entriesRead() const { return entries_read_; }

 private:
  /// An observed pair with the runs of its partners.
  struct Pair
  {
    KeyPair observed;
    std::uint32_t a = 0, b = 0;  // its key points
    double share_first = 0, share_second = 0;  // of their directions in the heading
    std::size_t count = 0;  // of entries in the runs
    std::size_t begin = 0, end = 0;  // of its runs
  };
  /// Of a proposal: how many pairs are known to support it, and the last of these.
  struct Support
  {
    std::uint32_t pairs = 0;
    std::uint32_t last = 0;
  };
  void propose(std::uint32_t pair);
  void countSupporters(std::uint32_t proposal);

  const KeyPairIndex& index_;
  std::vector<KeyPairIndex::Run> runs_;
  std::vector<Pair> pairs_;  // rarest first
  std::size_t next_ = 0;
  std::uint64_t entries_read_ = 0;
  std::vector<PoseProposal> proposals_;  // of all pairs so far
  std::vector<std::uint32_t> owners_;  // the pair of each proposal
  std::vector<Support>
      supports_;  // of the first proposals; those of the others are not counted yet
  std::uint32_t most_supporters_ = 0;  // of any of them
  std::vector<std::uint32_t> counted_for_;  // by pair: the last proposal that it supports, plus one
  NearPlaces<4096> counted_;  // where supports_ are
  std::vector<KeyPairIndex::Match> matches_;  // kept to be filled again
};
}  // namespace sigloc
