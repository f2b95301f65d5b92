// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/ClearBlocks.h"

#include <algorithm>
#include <utility>

#include "geometry/simd.h"

namespace sigloc
{
namespace
{
constexpr std::uint8_t kMostRings = 255;
constexpr std::uint32_t kWanted = ~0U;  // a tile that is stored, but has no place yet

/// Lowers each of n rings to one more than the least of the three blocks above, or below, it.
SIGLOC_WIDE_VECTORS void spreadFromRow(std::uint8_t* row, const std::uint8_t* beside, std::size_t n)
{
  const auto next = [](std::uint8_t ring)
  { return static_cast<std::uint8_t>(ring < kMostRings ? ring + 1 : kMostRings); };
  if (n > 1) row[0] = std::min(row[0], next(std::min(beside[0], beside[1])));
  if (n == 1) row[0] = std::min(row[0], next(beside[0]));
  for (std::size_t x = 1; x + 1 < n; ++x)
  {
    const std::uint8_t least = std::min(std::min(beside[x - 1], beside[x]), beside[x + 1]);
    row[x] = std::min(row[x], next(least));
  }
  if (n > 1) row[n - 1] = std::min(row[n - 1], next(std::min(beside[n - 2], beside[n - 1])));
}

/// Lowers each of n rings in `row` to what those left and right of it allow. `other` is as long.
SIGLOC_WIDE_VECTORS void spreadAlongRow(std::uint8_t* row, std::uint8_t* other, std::size_t n)
{
  // A way of up to 255 blocks is a sum of these steps, each taken at most once.
  for (std::size_t step = 1; step < n && step <= 128; step *= 2)
  {
    const auto add = static_cast<std::uint8_t>(step);
    const auto most = static_cast<std::uint8_t>(kMostRings - step);
    std::copy_n(row, n, other);
    for (std::size_t x = step; x < n; ++x)
    {
      const auto by_left = static_cast<std::uint8_t>(std::min(other[x - step], most) + add);
      row[x] = std::min(row[x], by_left);
    }
    for (std::size_t x = 0; x + step < n; ++x)
    {
      const auto by_right = static_cast<std::uint8_t>(std::min(other[x + step], most) + add);
      row[x] = std::min(row[x], by_right);
    }
  }
}

/// Computes the chessboard distance [blocks] to the nearest zero block, exact up to 255. Down and
/// up the rows it goes straight or over corners, which reaches all that are at least as far above
/// or below as beside. From there the others are reached along the row.
void spreadRings(std::vector<std::uint8_t>& rings, std::uint32_t width, std::uint32_t height)
{
  const auto row = [&](std::uint32_t y) { return &rings[std::size_t{y} * width]; };
  for (std::uint32_t y = 1; y < height; ++y) spreadFromRow(row(y), row(y - 1), width);
  for (std::uint32_t y = height; y-- > 1;) spreadFromRow(row(y - 1), row(y), width);
  std::vector<std::uint8_t> other(width);
  for (std::uint32_t y = 0; y < height; ++y) spreadAlongRow(row(y), other.data(), width);
}

bool isSolid(const DenseCell& cell)
{
  return cell.state() == CellState::solid_wall;
}

/// The solid walls in a part of the frame, as the bytes of its blocks; 0 in a block without any.
struct Walls
{
  std::uint32_t width, height;  // [blocks]
  std::vector<std::uint8_t> blocks;

  /// Of `cells_wide` by `cells_high` cells, from cell (x0, y0) on. x0 and y0 are even.
  template <class CellAt>
  Walls(std::uint32_t x0, std::uint32_t y0, std::uint32_t cells_wide, std::uint32_t cells_high,
        const CellAt& cell_at)
      : width((cells_wide + 1) / 2),
        height((cells_high + 1) / 2),
        blocks(std::size_t{width} * height)
  {
    for (std::uint32_t y = 0; y < cells_high; ++y)
    {
      std::uint8_t* const row = &blocks[std::size_t{y / 2} * width];
      for (std::uint32_t x = 0; x < cells_wide; ++x)
      {
        if (!isSolid(cell_at(x0 + x, y0 + y))) continue;
        row[x / 2] = static_cast<std::uint8_t>(row[x / 2] | ClearBlocks::bitOf(x, y));
      }
    }
  }

  /// Replaces each 0 by the distance to the nearest block with walls.
  void addDistances()
  {
    std::vector<std::uint8_t> rings(blocks.size());
    std::transform(blocks.begin(), blocks.end(), rings.begin(),
                   [](std::uint8_t walls) { return walls != 0 ? 0 : kMostRings; });
    spreadRings(rings, width, height);
    std::transform(blocks.begin(), blocks.end(), rings.begin(), blocks.begin(),
                   [](std::uint8_t walls, std::uint8_t ring)
                   {
                     if (walls != 0) return walls;
                     const int far = std::min(ring, ClearBlocks::kFarthest);
                     return static_cast<std::uint8_t>(ClearBlocks::kWalls + far);
                   });
  }
};
}  // namespace

ClearBlocks::ClearBlocks(const DenseField& field)
{
  const RasterFrame& frame = field.frame;
  width_ = static_cast<std::int32_t>((frame.width + 1) / 2);
  height_ = static_cast<std::int32_t>((frame.height + 1) / 2);
  if (!field.isTiled())
  {
    const DenseCell* const cells = field.cells.data();
    Walls walls(0, 0, frame.width, frame.height,
                [&](std::uint32_t x, std::uint32_t y) -> const DenseCell&
                { return cells[std::size_t{y} * frame.width + x]; });
    walls.addDistances();
    blocks_.reserve(walls.blocks.size() + 1);
    blocks_.assign(walls.blocks.begin(), walls.blocks.end());
    blocks_.push_back(kOutside);
    return;
  }
  columns_ = (width_ + kTileSide - 1) / kTileSide;
  rows_ = (height_ + kTileSide - 1) / kTileSide;
  tiles_.resize(indexOf(0, rows_));
  blocks_.assign(kTileBlocks, kWalls + kFarthest);  // for all tiles far from any wall
  wantAroundWalls(field);
  for (std::int32_t row = 0; row < rows_; ++row)
  {
    for (std::int32_t column = 0; column < columns_; ++column)
    {
      if (tiles_[indexOf(column, row)] != kWanted) continue;
      const auto first = static_cast<std::uint32_t>(blocks_.size() / kTileBlocks);
      solve(field, nameIsland(column, row), first);
    }
  }
  blocks_.shrink_to_fit();
}

void ClearBlocks::wantAroundWalls(const DenseField& field)
{
  constexpr std::int32_t kRatio =
      kSide * kTileSide / static_cast<std::int32_t>(DenseField::kTileSide);
  for (const StoredCells& stored : storedCells(field))
  {
    bool has_wall = false;
    for (std::uint32_t y = 0; y < stored.height && !has_wall; ++y)
    {
      has_wall = std::any_of(stored.row(y), stored.row(y) + stored.width, isSolid);
    }
    if (!has_wall) continue;
    const auto column = static_cast<std::int32_t>(stored.x / DenseField::kTileSide) / kRatio;
    const auto row = static_cast<std::int32_t>(stored.y / DenseField::kTileSide) / kRatio;
    for (std::int32_t j = std::max(0, row - kTilesAround);
         j <= std::min(rows_ - 1, row + kTilesAround); ++j)
    {
      const std::int32_t left = std::max(0, column - kTilesAround);
      const std::int32_t right = std::min(columns_ - 1, column + kTilesAround);
      std::fill_n(&tiles_[indexOf(left, j)], right - left + 1, kWanted);
    }
  }
}

/// Gives places to the wanted tiles that hang together with one, over corners too, and returns the
/// box around them. No wall of another such island is near.
ClearBlocks::TileBox ClearBlocks::nameIsland(std::int32_t column, std::int32_t row)
{
  TileBox box{column, column, row, row};
  std::vector<std::pair<std::int32_t, std::int32_t>> open;
  const auto take = [&](std::int32_t x, std::int32_t y)
  {
    std::uint32_t& tile = tiles_[indexOf(x, y)];
    if (tile != kWanted) return;
    tile = static_cast<std::uint32_t>(blocks_.size() / kTileBlocks);
    blocks_.resize(blocks_.size() + kTileBlocks);
    open.emplace_back(x, y);
  };
  take(column, row);
  for (std::size_t k = 0; k < open.size(); ++k)
  {
    const auto [x, y] = open[k];
    box = {std::min(box.left, x), std::max(box.right, x), std::min(box.bottom, y),
           std::max(box.top, y)};
    for (std::int32_t j = std::max(0, y - 1); j <= std::min(rows_ - 1, y + 1); ++j)
    {
      for (std::int32_t i = std::max(0, x - 1); i <= std::min(columns_ - 1, x + 1); ++i) take(i, j);
    }
  }
  return box;
}

/// Fills the tiles of an island, by the box around it. Its tiles have the places from `first` on;
/// those of other islands may lie in the box.
void ClearBlocks::solve(const DenseField& field, const TileBox& box, std::uint32_t first)
{
  constexpr std::int32_t kTileWidth = kSide * kTileSide;
  const auto x0 = static_cast<std::uint32_t>(box.left * kTileWidth);
  const auto y0 = static_cast<std::uint32_t>(box.bottom * kTileWidth);
  Walls walls(
      x0, y0,
      std::min(static_cast<std::uint32_t>((box.right + 1) * kTileWidth), field.frame.width) - x0,
      std::min(static_cast<std::uint32_t>((box.top + 1) * kTileWidth), field.frame.height) - y0,
      [&](std::uint32_t x, std::uint32_t y) -> const DenseCell& { return field.at(x, y); });
  walls.addDistances();
  for (std::uint32_t y = 0; y < walls.height; ++y)
  {
    for (std::int32_t column = box.left; column <= box.right; ++column)
    {
      const std::uint32_t tile =
          tiles_[indexOf(column, box.bottom + static_cast<std::int32_t>(y) / kTileSide)];
      if (tile < first || tile == kWanted) continue;
      const auto x = static_cast<std::uint32_t>((column - box.left) * kTileSide);
      std::copy_n(&walls.blocks[std::size_t{y} * walls.width + x],
                  std::min(static_cast<std::uint32_t>(kTileSide), walls.width - x),
                  &blocks_[tile * kTileBlocks + std::size_t{y % kTileSide} * kTileSide]);
    }
  }
}
}  // namespace sigloc
