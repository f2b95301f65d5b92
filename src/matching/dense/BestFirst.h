// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
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
    const auto is_far = [&](std::uint64_t key) { return scoreOf(key) + near < best; };
    const auto first = std::partition(keys_.begin(), keys_.end(), is_far);
    first_ = static_cast<std::size_t>(first - keys_.begin());
    std::make_heap(first, keys_.end());
  }

  bool empty() const { return keys_.empty(); }

  std::uint32_t bestScore() const { return scoreOf(keys_[first_]); }

  /// Takes the best one. Returns its index.
  std::uint32_t take()
  {
    const auto index = ~static_cast<std::uint32_t>(keys_[first_]);
    std::pop_heap(heap(), keys_.end());
    keys_.pop_back();
    if (keys_.size() == first_)
    {
      first_ = 0;
      std::make_heap(heap(), keys_.end());
    }
    return index;
  }

 private:
  static std::uint32_t scoreOf(std::uint64_t key) { return static_cast<std::uint32_t>(key >> 32U); }

  std::vector<std::uint64_t>::iterator heap()
  {
    return keys_.begin() + static_cast<std::ptrdiff_t>(first_);
  }

  std::vector<std::uint64_t> keys_;
  std::size_t first_;  // from here on the keys are a heap, the best one here
};
}  // namespace sigloc
