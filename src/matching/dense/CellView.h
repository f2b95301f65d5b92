// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// A pose with the cosine and sine of its heading.
struct Placement
{
  explicit Placement(const mrpt::math::TPose2D& pose)
      : x(static_cast<float>(pose.x)),
        y(static_cast<float>(pose.y)),
        c(std::cos(static_cast<float>(pose.phi))),
        s(std::sin(static_cast<float>(pose.phi)))
  {
  }
  float placedX(float px, float py) const { return x + c * px - s * py; }
  float placedY(float px, float py) const { return y + s * px + c * py; }
  float x, y, c, s;
};

/// Look-up of cells by map coordinates. Everything outside the raster is one unknown cell.
class CellView
{
 public:
  explicit CellView(const DenseField& field)
      : cells_(field.cells.data()),
        tiles_(field.isTiled() ? field.tiles.data() : nullptr),
        tile_columns_(field.tileColumns()),
        x0_(static_cast<float>(field.frame.origin.x)),
        y0_(static_cast<float>(field.frame.origin.y)),
        scale_(static_cast<float>(1.0 / field.frame.resolution)),
        resolution_(static_cast<float>(field.frame.resolution)),
        width_(static_cast<std::int32_t>(field.frame.width)),
        height_(static_cast<std::int32_t>(field.frame.height))
  {
  }

  float resolution() const { return resolution_; }  ///< [m]

  const DenseCell& at(float x, float y) const { return cellAt(column(x), row(y)); }

  /// The cells in which many points fall, and their positions in these cells. The loops have no
  /// branches, so that compilers can process several points at once.
  struct Block
  {
    static constexpr std::size_t kSize = 64;
    std::array<std::int32_t, kSize> ix, iy;  ///< cell; for a point outside, any cell outside
    std::array<float, kSize> fx, fy;  ///< [cells] from the middle of the cell
    std::array<std::uint32_t, kSize> packed;  ///< dx, dy and code of the cell, dx lowest

    /// Finds the cells of `count` <= kSize points [m] of the robot frame, placed at `place`.
    void fill(const CellView& view, const Placement& place, const float* x, const float* y,
              std::size_t count)
    {
      std::int32_t outside = 0;
      for (std::size_t i = 0; i < count; ++i)
      {
        fx[i] = view.bordered(place.placedX(x[i], y[i]), view.x0_, view.width_);
        fy[i] = view.bordered(place.placedY(x[i], y[i]), view.y0_, view.height_);
        ix[i] = static_cast<std::int32_t>(fx[i]);
        iy[i] = static_cast<std::int32_t>(fy[i]);
        fx[i] -= static_cast<float>(ix[i]) + 0.5F;
        fy[i] -= static_cast<float>(iy[i]) + 0.5F;
        outside |= static_cast<std::int32_t>(ix[i] < 1) | static_cast<std::int32_t>(iy[i] < 1) |
                   static_cast<std::int32_t>(ix[i] > view.width_) |
                   static_cast<std::int32_t>(iy[i] > view.height_);
      }
      if (outside != 0)
      {
        for (std::size_t i = 0; i < count; ++i) packed[i] = pack(view.cellAt(ix[i], iy[i]));
        return;
      }
      if (view.tiles_ != nullptr)
      {
        fillTiled(view, count);
        return;
      }
      const DenseCell* before = view.cells_ - view.width_ - 1;
      for (std::size_t i = 0; i < count; ++i)
      {
        packed[i] = word(before[static_cast<std::ptrdiff_t>(iy[i]) * view.width_ + ix[i]]);
      }
    }

    std::uint8_t distance(std::size_t i) const
    {
      return static_cast<std::uint8_t>(packed[i] >> 16 & DenseCell::kFar);
    }
    std::int32_t dx(std::size_t i) const
    {
      return static_cast<std::int32_t>(packed[i] << 24) >> 24;
    }
    std::int32_t dy(std::size_t i) const
    {
      return static_cast<std::int32_t>(packed[i] << 16) >> 24;
    }
    CellState state(std::size_t i) const
    {
      return DenseCell::stateOf(static_cast<std::uint8_t>(packed[i] >> 16));
    }

    /// From the ridge of the nearest wall to the point [m], where `distance` is not kFar.
    float offsetX(std::size_t i, float resolution) const
    {
      return fx[i] * resolution - static_cast<float>(dx(i)) * kOffsetUnit;
    }
    float offsetY(std::size_t i, float resolution) const
    {
      return fy[i] * resolution - static_cast<float>(dy(i)) * kOffsetUnit;
    }

   private:
    /// Looks up cells of a field in tiles. All must be in the frame.
    void fillTiled(const CellView& view, std::size_t count)
    {
      constexpr std::uint32_t kSide = DenseField::kTileSide;
      std::array<std::uint32_t, kSize> tile, in_tile;
      for (std::size_t i = 0; i < count; ++i)
      {
        const auto x = static_cast<std::uint32_t>(ix[i] - 1);
        const auto y = static_cast<std::uint32_t>(iy[i] - 1);
        tile[i] = y / kSide * view.tile_columns_ + x / kSide;
        in_tile[i] = y % kSide * kSide + x % kSide;
      }
      for (std::size_t i = 0; i < count; ++i)
      {
        const std::size_t first = view.tiles_[tile[i]] * std::size_t{DenseField::kTileCells};
        packed[i] = word(view.cells_[first + in_tile[i]]);
      }
    }

    static constexpr auto kOffsetUnit = static_cast<float>(DenseField::kOffsetUnit);

    /// Reads a stored cell at once, and the byte behind it, which is dropped.
    static std::uint32_t word(const DenseCell& stored)
    {
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
      std::uint32_t bytes = 0;
      std::memcpy(&bytes, static_cast<const void*>(&stored), sizeof(bytes));
      return bytes & 0xFFFFFFU;
#else
      return pack(stored);
#endif
    }

    /// Packs the members of a cell. They are then separated for several points at once.
    static std::uint32_t pack(const DenseCell& cell)
    {
      return static_cast<std::uint32_t>(static_cast<std::uint8_t>(cell.dx)) |
             static_cast<std::uint32_t>(static_cast<std::uint8_t>(cell.dy)) << 8 |
             static_cast<std::uint32_t>(cell.code()) << 16;
    }
  };

 private:
  /// Returns a coordinate in cells plus one. All before the raster is cell 0, and all beyond it is
  /// the cell after its last.
  float bordered(float x, float origin, std::int32_t size) const
  {
    const float cells = (x - origin) * scale_ + 1.0F;
    return std::min(std::max(cells, 0.0F), static_cast<float>(size + 1));
  }
  std::int32_t column(float x) const
  {
    return static_cast<std::int32_t>(bordered(x, x0_, width_));
  }
  std::int32_t row(float y) const
  {
    return static_cast<std::int32_t>(bordered(y, y0_, height_));
  }

  const DenseCell& cellAt(std::int32_t column, std::int32_t row) const
  {
    if (column < 1 || row < 1 || column > width_ || row > height_) return outside_;
    if (tiles_ != nullptr) return storedAt(column, row);
    return cells_[static_cast<std::size_t>(row - 1) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(column - 1)];
  }

  /// Returns a cell of a field in tiles; column and row count from 1 and must be in the frame.
  const DenseCell& storedAt(std::int32_t column, std::int32_t row) const
  {
    constexpr std::uint32_t kSide = DenseField::kTileSide;
    const auto x = static_cast<std::uint32_t>(column - 1);
    const auto y = static_cast<std::uint32_t>(row - 1);
    const std::uint32_t tile = tiles_[y / kSide * tile_columns_ + x / kSide];
    return cells_[tile * std::size_t{DenseField::kTileCells} + (y % kSide * kSide + x % kSide)];
  }

  const DenseCell* cells_;
  const std::uint32_t* tiles_;  // null where the whole frame is stored
  std::uint32_t tile_columns_;
  float x0_, y0_, scale_, resolution_;
  std::int32_t width_, height_;
  DenseCell outside_;
};
}  // namespace sigloc
