// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eval/methods/lattice/DenseSearchSpace.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sigloc::detail
{
/// Keeps the best poses offered, whatever the order in which they come.
class BestLatticePoses
{
 public:
  explicit BestLatticePoses(std::size_t capacity) : capacity_(capacity) {}

  /// A pose with a lower score than this cannot enter.
  std::uint32_t threshold() const { return threshold_; }

  void offer(const LatticePose& pose)
  {
    if (heap_.size() == capacity_)
    {
      if (!ranksBefore(pose, heap_.front())) return;
      std::pop_heap(heap_.begin(), heap_.end(), ranksBefore);
      heap_.back() = pose;
    }
    else
    {
      heap_.push_back(pose);
    }
    std::push_heap(heap_.begin(), heap_.end(), ranksBefore);
    if (heap_.size() == capacity_) threshold_ = heap_.front().score;
  }

  std::vector<LatticePose> sorted() const
  {
    std::vector<LatticePose> poses = heap_;
    std::sort(poses.begin(), poses.end(), ranksBefore);
    return poses;
  }

 private:
  std::size_t capacity_;
  std::uint32_t threshold_ = 0;
  std::vector<LatticePose> heap_;  // the worst on top
};

/// Steps within a row-major grid of `stride` cells a row.
inline std::vector<std::ptrdiff_t> flatOffsets(const std::vector<CellOffset>& offsets,
                                               std::int32_t stride)
{
  std::vector<std::ptrdiff_t> steps;
  steps.reserve(offsets.size());
  for (const CellOffset& offset : offsets)
  {
    steps.push_back(static_cast<std::ptrdiff_t>(offset.dy) * stride + offset.dx);
  }
  return steps;
}
}  // namespace sigloc::detail
