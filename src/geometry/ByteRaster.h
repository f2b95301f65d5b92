// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/LargeVector.h"

namespace sigloc
{
/// A raster of bytes that is stored whole, or in tiles that are made where something is written.
class ByteRaster
{
 public:
  static constexpr std::uint32_t kTileSide = 64;  ///< [cells]
  static constexpr std::size_t kTileBytes = std::size_t{kTileSide} * kTileSide;

  ByteRaster() = default;
  /// All bytes are 0.
  ByteRaster(std::uint32_t width, std::uint32_t height, bool in_tiles)
      : width_(width),
        height_(height),
        tile_columns_((width + kTileSide - 1) / kTileSide),
        tiles_(in_tiles ? std::size_t{tile_columns_} * ((height + kTileSide - 1) / kTileSide) : 0),
        bytes_(in_tiles ? kTileBytes : std::size_t{width} * height)
  {
  }

  /// Returns a byte to write to; makes its tile where there is none.
  std::uint8_t& at(std::size_t x, std::size_t y)
  {
    if (tiles_.empty()) return bytes_[y * width_ + x];
    std::uint32_t& tile = tiles_[y / kTileSide * tile_columns_ + x / kTileSide];
    if (tile == 0) tile = addTile();
    return bytes_[tile * kTileBytes + y % kTileSide * kTileSide + x % kTileSide];
  }

  /// Calls `visit(x, y)` for every byte that is not 0.
  template <class Visit>
  void forEachSet(const Visit& visit) const
  {
    const std::uint32_t step_x = tiles_.empty() ? width_ : kTileSide;
    const std::uint32_t step_y = tiles_.empty() ? height_ : kTileSide;
    for (std::uint32_t y = 0; y < height_; y += step_y)
    {
      for (std::uint32_t x = 0; x < width_; x += step_x)
      {
        const std::uint8_t* first = bytes_.data() + firstOf(x, y);
        for (std::uint32_t k = 0; k < step_x * step_y; ++k)
        {
          if (first[k] != 0) visit(x + k % step_x, y + k / step_x);
        }
      }
    }
  }

  /// Gives up the memory that was reserved to grow into.
  void finish() { bytes_.shrink_to_fit(); }

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  std::uint32_t tileColumns() const { return tile_columns_; }
  const std::uint8_t* bytes() const { return bytes_.data(); }
  /// Returns the place of each tile among the bytes, row by row; null where they are stored whole.
  const std::uint32_t* tiles() const { return tiles_.empty() ? nullptr : tiles_.data(); }

 private:
  std::uint32_t addTile()
  {
    const std::size_t first = bytes_.size();
    bytes_.resize(first + kTileBytes);
    return static_cast<std::uint32_t>(first / kTileBytes);
  }
  /// Returns the index of the first byte of the whole raster or of a tile. Tiles without anything
  /// in them share one that is 0 everywhere.
  std::size_t firstOf(std::uint32_t x, std::uint32_t y) const
  {
    if (tiles_.empty()) return 0;
    return tiles_[std::size_t{y / kTileSide} * tile_columns_ + x / kTileSide] * kTileBytes;
  }

  std::uint32_t width_ = 0, height_ = 0, tile_columns_ = 0;
  std::vector<std::uint32_t> tiles_;
  LargeVector<std::uint8_t> bytes_;
};
}  // namespace sigloc
