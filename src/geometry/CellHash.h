// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "geometry/cell_key.h"

namespace sigloc
{
/// Places with an index each, hashed into square cells, so that those near a place are found
/// without going through all.
class CellHash
{
 public:
  /// `cell` > 0 [m] is the distance up to which places are found for certain.
  explicit CellHash(double cell) : cell_(cell) {}

  void add(const mrpt::math::TPoint2D& place, std::uint32_t index)
  {
    cells_[cellKey(cellOf(place.x), cellOf(place.y))].push_back(index);
  }

  /// The same, unless the cell of the place holds the index already.
  void addOnce(const mrpt::math::TPoint2D& place, std::uint32_t index)
  {
    std::vector<std::uint32_t>& cell = cells_[cellKey(cellOf(place.x), cellOf(place.y))];
    if (std::find(cell.begin(), cell.end(), index) == cell.end()) cell.push_back(index);
  }

  /// Calls `visit(index)` for every place in the cell of `place`.
  template <class Visit>
  void forEachInCell(const mrpt::math::TPoint2D& place, Visit&& visit) const
  {
    visitCell(cellOf(place.x), cellOf(place.y), visit);
  }

  /// Calls `visit(index)` for every place within a cell's size of `place`, and for others a little
  /// farther away; several times for an index that was added several times.
  template <class Visit>
  void forEachNear(const mrpt::math::TPoint2D& place, Visit&& visit) const
  {
    const std::int64_t x = cellOf(place.x);
    const std::int64_t y = cellOf(place.y);
    for (std::int64_t dy = -1; dy <= 1; ++dy)
    {
      for (std::int64_t dx = -1; dx <= 1; ++dx)
      {
        visitCell(x + dx, y + dy, visit);
      }
    }
  }

 private:
  template <class Visit>
  void visitCell(std::int64_t x, std::int64_t y, Visit& visit) const
  {
    const auto cell = cells_.find(cellKey(x, y));
    if (cell == cells_.end()) return;
    for (const std::uint32_t index : cell->second) visit(index);
  }

  std::int64_t cellOf(double x) const { return static_cast<std::int64_t>(std::floor(x / cell_)); }

  double cell_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};
}  // namespace sigloc
