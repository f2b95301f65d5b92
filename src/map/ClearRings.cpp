// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/ClearRings.h"

#include <algorithm>
#include <utility>

#include "geometry/simd.h"

namespace sigloc
{
namespace
{
constexpr std::uint8_t kMostRings = 255;
constexpr std::uint32_t kWanted = ~0U;  // a tile that is stored, but has no place yet

/// Lowers each of n rings to one more than the least of the three cells above, or below, it.
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
  // A way of up to 255 cells is a sum of these steps, each taken at most once.
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

/// Computes the chessboard distance [cells] to the nearest zero cell, exact up to 255. Down and up
/// the rows it goes straight or over corners, which reaches all that are at least as far above or
/// below as beside. From there the others are reached along the row.
void spreadRings(std::vector<std::uint8_t>& rings, std::uint32_t width, std::uint32_t height)
{
  const auto row = [&](std::uint32_t y) { return &rings[std::size_t{y} * width]; };
  for (std::uint32_t y = 1; y < height; ++y) spreadFromRow(row(y), row(y - 1), width);
  for (std::uint32_t y = height; y-- > 1;) spreadFromRow(row(y - 1), row(y), width);
  std::vector<std::uint8_t> other(width);
  for (std::uint32_t y = 0; y < height; ++y) spreadAlongRow(row(y), other.data(), width);
}

std::uint8_t ringsAt(const DenseCell& cell)
{
  return cell.state == CellState::solid_wall ? 0 : kMostRings;
}
}  // namespace

ClearRings::ClearRings(const DenseField& field)
{
  const RasterFrame& frame = field.frame;
  if (!field.isTiled())
  {
    rings_.resize(field.cells.size() + 1);
    std::transform(field.cells.begin(), field.cells.end(), rings_.begin(), ringsAt);
    spreadRings(rings_, frame.width, frame.height);
    rings_.back() = kOutside;
    return;
  }
  columns_ = static_cast<std::int32_t>((frame.width + kTileSide - 1) / kTileSide);
  rows_ = static_cast<std::int32_t>((frame.height + kTileSide - 1) / kTileSide);
  tiles_.resize(indexOf(0, rows_));
  rings_.assign(kTileCells, kMostRings);  // for all tiles far from any wall
  wantAroundWalls(field);
  for (std::int32_t row = 0; row < rows_; ++row)
  {
    for (std::int32_t column = 0; column < columns_; ++column)
    {
      if (tiles_[indexOf(column, row)] != kWanted) continue;
      const auto first = static_cast<std::uint32_t>(rings_.size() / kTileCells);
      solve(field, nameIsland(column, row), first);
    }
  }
  rings_.shrink_to_fit();
}

void ClearRings::wantAroundWalls(const DenseField& field)
{
  constexpr std::int32_t kRatio = kTileSide / static_cast<std::int32_t>(DenseField::kTileSide);
  for (const StoredCells& stored : storedCells(field))
  {
    bool has_wall = false;
    for (std::uint32_t y = 0; y < stored.height && !has_wall; ++y)
    {
      has_wall =
          std::any_of(stored.row(y), stored.row(y) + stored.width,
                      [](const DenseCell& cell) { return cell.state == CellState::solid_wall; });
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
ClearRings::TileBox ClearRings::nameIsland(std::int32_t column, std::int32_t row)
{
  TileBox box{column, column, row, row};
  std::vector<std::pair<std::int32_t, std::int32_t>> open;
  const auto take = [&](std::int32_t x, std::int32_t y)
  {
    std::uint32_t& tile = tiles_[indexOf(x, y)];
    if (tile != kWanted) return;
    tile = static_cast<std::uint32_t>(rings_.size() / kTileCells);
    rings_.resize(rings_.size() + kTileCells);
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
void ClearRings::solve(const DenseField& field, const TileBox& box, std::uint32_t first)
{
  const auto x0 = static_cast<std::uint32_t>(box.left * kTileSide);
  const auto y0 = static_cast<std::uint32_t>(box.bottom * kTileSide);
  const std::uint32_t width =
      std::min(static_cast<std::uint32_t>((box.right + 1) * kTileSide), field.frame.width) - x0;
  const std::uint32_t height =
      std::min(static_cast<std::uint32_t>((box.top + 1) * kTileSide), field.frame.height) - y0;
  std::vector<std::uint8_t> rings;
  rings.reserve(std::size_t{width} * height);
  for (std::uint32_t y = 0; y < height; ++y)
  {
    for (std::uint32_t x = 0; x < width; ++x) rings.push_back(ringsAt(field.at(x0 + x, y0 + y)));
  }
  spreadRings(rings, width, height);
  for (std::uint32_t y = 0; y < height; ++y)
  {
    for (std::int32_t column = box.left; column <= box.right; ++column)
    {
      const std::uint32_t tile =
          tiles_[indexOf(column, box.bottom + static_cast<std::int32_t>(y) / kTileSide)];
      if (tile < first || tile == kWanted) continue;
      const auto x = static_cast<std::uint32_t>((column - box.left) * kTileSide);
      std::copy_n(&rings[std::size_t{y} * width + x],
                  std::min(static_cast<std::uint32_t>(kTileSide), width - x),
                  &rings_[tile * kTileCells + std::size_t{y % kTileSide} * kTileSide]);
    }
  }
}
}  // namespace sigloc
