// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "map/building/BeamCounts.h"
#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// The dense field over counts that grow, perhaps on top of an earlier field. Only the surroundings
/// of walls that changed are solved again. So the cost of a scan depends on what it saw, not on the
/// size of the map. The result equals `buildDenseField` of the whole raster, cell by cell. On top
/// of a field, it equals that of its `rasterOf` where anything has changed, and the field
/// elsewhere.
class GrowingField
{
 public:
  GrowingField() = default;
  /// Starts on top of `base`, which must not be empty. The counts must have its resolution and be
  /// anchored at its origin.
  explicit GrowingField(const DenseField& base);

  /// Updates the field by what has changed in `counts`, which must always be the same object. Where
  /// a cell of the counts is unknown, the field stays.
  void update(BeamCounts& counts, std::uint32_t min_scans);

  /// Returns the present field, with some unknown cells around it to grow into.
  const DenseField& field() const { return field_; }
  /// Returns the field without those unknown cells.
  DenseField cropped() const;

  std::uint64_t cellsSolved() const { return cells_solved_; }  ///< work done, in cells

 private:
  void growTo(const CellBox& wanted, const BeamCounts& counts);
  bool takeCells(const CellIndex& first, const BeamCounts::TileCells& tile, CellBox& changed);
  void setState(DenseCell& cell, CellState state);
  void solveAround(const std::vector<CellBox>& changed);
  void solve(const CellBox& box);
  /// Index in field_ and hits_ of a cell of the counts.
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
