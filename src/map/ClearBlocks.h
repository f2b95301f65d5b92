// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/LargeVector.h"
#include "geometry/simd.h"
#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Tells how far a beam may go on from a cell before it can meet a solid wall. There is one byte
/// for each block of two by two cells:
///
/// - 1 to kWalls: there are solid walls in the block, one bit for each of its cells;
/// - kWalls + n: the nearest block with any is n blocks away along either axis, or farther where n
///   is kFarthest;
/// - 0, only outside the frame: nothing is known about the neighbours.
///
/// For a field in tiles, the bytes are in tiles too. So many around a wall are stored that all
/// others have kWalls + kFarthest.
class ClearBlocks
{
 public:
  static constexpr std::int32_t kSide = 2;  ///< [cells] of a block
  static constexpr std::uint8_t kWalls = 15;
  static constexpr std::uint8_t kFarthest = 128;
  static constexpr std::uint8_t kOutside = 0;

  explicit ClearBlocks(const DenseField& field);

  bool isTiled() const { return !tiles_.empty(); }
  /// Returns the bytes of the whole frame, row by row, with kOutside after the last. Only where it
  /// is not in tiles.
  const std::uint8_t* whole() const { return blocks_.data(); }
  std::int32_t width() const { return width_; }  ///< [blocks]
  std::int32_t height() const { return height_; }  ///< [blocks]
  /// Looks up the bytes of eight blocks in the frame. Only where it is in tiles.
  void loadTiled(const WideInt& x, const WideInt& y, WideInt& bytes) const
  {
    constexpr std::int32_t kInTile = kTileSide - 1;
    WideInt tile;
    loadWide(tiles_.data(), (y >> kTileBits) * columns_ + (x >> kTileBits), tile);
    const WideInt in_tile = ((y & kInTile) << kTileBits) + (x & kInTile);
    const auto at = [&](std::size_t k)
    {
      const auto first = std::size_t{static_cast<std::uint32_t>(tile[k])} << 2 * kTileBits;
      return std::int32_t{blocks_[first + static_cast<std::size_t>(in_tile[k])]};
    };
    bytes = WideInt{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
  }

  /// Returns the bit of a cell in the byte of a block with walls.
  static constexpr std::uint32_t bitOf(std::uint32_t x, std::uint32_t y)
  {
    return 1U << ((y % kSide) * kSide + x % kSide);
  }

 private:
  // Two tiles reach as far as kFarthest.
  static constexpr std::int32_t kTileBits = 6;
  static constexpr std::int32_t kTileSide = 1 << kTileBits;  // [blocks]
  static constexpr std::size_t kTileBlocks = std::size_t{kTileSide} * kTileSide;
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

  std::int32_t width_ = 0, height_ = 0;  // [blocks]
  std::int32_t columns_ = 0, rows_ = 0;  // [tiles]
  std::vector<std::uint32_t> tiles_;  // place of each tile in blocks_; empty: the frame is stored
  LargeVector<std::uint8_t> blocks_;
};
}  // namespace sigloc
