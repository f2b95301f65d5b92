// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// For every cell of a field, the number of rings of cells around it without a solid wall, up to
/// 255; 0 for a solid wall itself. For a field in tiles, it is stored in tiles too. So many cells
/// around a wall are stored that all others have 255.
class ClearRings
{
 public:
  /// For all cells outside the frame: a wall just inside may be near.
  static constexpr std::uint8_t kOutside = 1;

  explicit ClearRings(const DenseField& field);

  bool isTiled() const { return !tiles_.empty(); }
  /// Returns the rings of the whole frame, row by row, with kOutside after the last. Only where it
  /// is not in tiles.
  const std::uint8_t* whole() const { return rings_.data(); }
  /// Returns the rings of a cell in the frame. Only where it is in tiles.
  std::uint8_t inTile(std::int32_t x, std::int32_t y) const
  {
    constexpr std::uint32_t kSide = kTileSide;
    const auto column = static_cast<std::uint32_t>(x);
    const auto row = static_cast<std::uint32_t>(y);
    const std::size_t tile =
        tiles_[row / kSide * static_cast<std::uint32_t>(columns_) + column / kSide];
    return rings_[tile * kTileCells + (row % kSide * kSide + column % kSide)];
  }

 private:
  // Large tiles, because all around a wall is stored: two of them reach farther than 255 cells.
  static constexpr std::int32_t kTileSide = 128;  // [cells]
  static constexpr std::size_t kTileCells = std::size_t{kTileSide} * kTileSide;
  static constexpr std::int32_t kTilesAround = 2;

  struct TileBox
  {
    std::int32_t left, right, bottom, top;  // right and top: of the last tiles
  };

  std::size_t indexOf(std::int32_t column, std::int32_t row) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  void wantAroundWalls(const DenseField& field);
  TileBox nameIsland(std::int32_t column, std::int32_t row);
  void solve(const DenseField& field, const TileBox& box, std::uint32_t first);

  std::int32_t columns_ = 0, rows_ = 0;  // [tiles]
  std::vector<std::uint32_t> tiles_;  // place of each tile in rings_; empty: the frame is stored
  std::vector<std::uint8_t> rings_;
};
}  // namespace sigloc
