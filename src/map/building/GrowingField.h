// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "map/building/BeamCounts.h"
#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// The dense field over counts that grow, perhaps on top of a field that was there before: only the
/// surroundings of walls that changed are solved again, so that a look costs what it saw, however
/// large the map. Equal, cell by cell, to `buildDenseField` of the whole raster; on top of a field,
/// that of its `rasterOf` where anything has changed, and the field itself elsewhere.
class GrowingField
{
 public:
  GrowingField() = default;
  /// On top of `base`, which must not be empty. The counts must be of its resolution, anchored at
  /// its origin.
  explicit GrowingField(DenseField base);

  /// Takes over what has changed in `counts`, always the same ones; where they know nothing, the
  /// field stays.
  void update(BeamCounts& counts, std::uint32_t min_looks);

  /// The field now, with some unknown cells around it to grow into.
  const DenseField& field() const { return field_; }
  /// The field without those.
  DenseField cropped() const;

  std::uint64_t cellsSolved() const { return cells_solved_; }  ///< work done, in cells

 private:
  void growTo(const CellBox& wanted, const BeamCounts& counts);
  bool takeCells(const CellIndex& first, const BeamCounts::TileCells& tile, CellBox& changed);
  void setState(DenseCell& cell, CellState state);
  void solveAround(const std::vector<CellBox>& changed);
  void solve(const CellBox& box);
  /// Of a cell of the counts, in field_ and hits_.
  std::size_t indexOf(std::int32_t x, std::int32_t y) const
  {
    return static_cast<std::size_t>(y - box_.low.y) * field_.frame.width +
           static_cast<std::size_t>(x - box_.low.x);
  }

  DenseField field_;
  std::vector<WallHits> hits_;  // of field_'s cells
  CellBox box_;  // of field_, in cells of the counts
  CellBox tight_;  // without the cells to grow into
  RasterFrame tight_frame_;
  std::int64_t free_cells_ = 0;
  std::uint64_t cells_solved_ = 0;
};
}  // namespace sigloc
