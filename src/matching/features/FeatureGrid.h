// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "signature/DirectedFeature.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace sigloc
{
/// A spatial hash that finds the map features near a point. The plane is divided into square cells,
/// which are folded onto a table of fixed size. So neighbouring cells are neighbours in memory, and
/// distant features cost nothing. A segment is in every cell along it.
class FeatureGrid
{
 public:
  explicit FeatureGrid(const std::vector<Feature>& features);

  /// Calls visit(index) for every feature of the type within `radius` [m] of the place. For a
  /// segment, a sample point must be within radius + cell, and it may be visited more than once.
  /// Returns how many cells and entries of them were read.
  template <class Visit>
  std::uint64_t visitNear(const mrpt::math::TPoint2D& place, double radius, FeatureType type,
                          Visit&& visit) const;

  /// Prefetches the memory of the place's cell before a visit.
  void prefetch(const mrpt::math::TPoint2D& place) const
  {
    __builtin_prefetch(&starts_[slotOf(cellOf(place.x - origin_.x), cellOf(place.y - origin_.y))]);
  }
  double cellSize() const { return cell_; }

 private:
  struct Entry
  {
    float x;  ///< [m] from origin_
    float y;
    std::uint32_t feature;
    FeatureType type;
  };
  struct Sample
  {
    std::size_t slot;
    Entry entry;
  };
  void chooseCell(const std::vector<Feature>& features);
  std::vector<Sample> sampled(const std::vector<Feature>& features) const;
  void sortIntoSlots(const std::vector<Sample>& samples, std::size_t slots);
  std::int64_t cellOf(double coordinate) const
  {
    return static_cast<std::int64_t>(std::floor(coordinate / cell_));
  }
  std::size_t slotOf(std::int64_t ix, std::int64_t iy) const
  {
    return (static_cast<std::size_t>(iy) & row_mask_) * (column_mask_ + 1) +
           (static_cast<std::size_t>(ix) & column_mask_);
  }

  mrpt::math::TPoint2D origin_;
  double cell_ = 1;
  std::size_t column_mask_ = 0;
  std::size_t row_mask_ = 0;
  std::vector<std::uint32_t> starts_;
  std::vector<Entry> entries_;
};

template <class Visit>
std::uint64_t FeatureGrid::visitNear(const mrpt::math::TPoint2D& place, double radius,
                                     FeatureType type, Visit&& visit) const
{
  const double reach = isSegment(type) ? radius + cell_ : radius;
  const double x = place.x - origin_.x;
  const double y = place.y - origin_.y;
  const double squared_reach = reach * reach * (1 + 1e-6);
  const std::int64_t ix0 = cellOf(x - reach);
  const std::int64_t iy0 = cellOf(y - reach);
  // A reach beyond the table would wrap around to the same slots.
  const std::int64_t ix1 =
      std::min(cellOf(x + reach), ix0 + static_cast<std::int64_t>(column_mask_));
  const std::int64_t iy1 = std::min(cellOf(y + reach), iy0 + static_cast<std::int64_t>(row_mask_));
  auto read = static_cast<std::uint64_t>((ix1 - ix0 + 1) * (iy1 - iy0 + 1));
  for (std::int64_t iy = iy0; iy <= iy1; ++iy)
  {
    for (std::int64_t ix = ix0; ix <= ix1; ++ix)
    {
      const std::size_t slot = slotOf(ix, iy);
      read += starts_[slot + 1] - starts_[slot];
      for (std::uint32_t e = starts_[slot]; e < starts_[slot + 1]; ++e)
      {
        const Entry& entry = entries_[e];
        const double dx = static_cast<double>(entry.x) - x;
        const double dy = static_cast<double>(entry.y) - y;
        if (entry.type == type && dx * dx + dy * dy <= squared_reach) visit(entry.feature);
      }
    }
  }
  return read;
}
}  // namespace sigloc
