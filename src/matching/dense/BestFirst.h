// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "matching/dense/CoarseField.h"

namespace sigloc
{
/// Proposals, taken best first; of equal ones that which came first. Mostly only the few whose
/// score is near the best are taken. So these are ordered, and the others not before one of them is
/// asked for.
class BestFirst
{
 public:
  /// `near` is how far below the best score a proposal is that may well be taken.
  BestFirst(const std::vector<CoarseScore>& scores, std::uint32_t near)
  {
    keys_.reserve(scores.size());
    std::uint32_t best = 0;
    for (const CoarseScore& entry : scores)
    {
      keys_.push_back(std::uint64_t{entry.score} << 32U | ~entry.index);
      best = std::max(best, entry.score);
    }
    for (std::uint64_t& key : keys_)
    {
      if (scoreOf(key) + near >= best) continue;
      best_far_ = std::max(best_far_, scoreOf(key));
      std::swap(key, keys_[far_++]);
    }
    std::make_heap(heap(), keys_.end());
  }

  bool empty() const { return keys_.empty(); }

  std::uint32_t bestScore() const { return keys_.size() > far_ ? scoreOf(keys_[far_]) : best_far_; }

  /// Takes the best one. Returns its index.
  std::uint32_t take()
  {
    if (keys_.size() == far_)
    {
      far_ = 0;
      std::make_heap(heap(), keys_.end());
    }
    const auto index = ~static_cast<std::uint32_t>(keys_[far_]);
    std::pop_heap(heap(), keys_.end());
    keys_.pop_back();
    return index;
  }

 private:
  static std::uint32_t scoreOf(std::uint64_t key) { return static_cast<std::uint32_t>(key >> 32U); }

  std::vector<std::uint64_t>::iterator heap()
  {
    return keys_.begin() + static_cast<std::ptrdiff_t>(far_);
  }

  // The first `far_` in any order, then a heap with the best one at its front.
  std::vector<std::uint64_t> keys_;
  std::size_t far_ = 0;
  std::uint32_t best_far_ = 0;
};
}  // namespace sigloc
