// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/field_tiles.h"

#include <algorithm>
#include <stdexcept>

#include "map/map_values.h"

namespace sigloc
{
namespace
{
constexpr std::uint32_t kSide = DenseField::kTileSide;

bool isBlankCell(const DenseCell& cell)
{
  return cell.distance() == DenseCell::kFar && cell.state() == CellState::unknown;
}

bool isBlank(const StoredCells& cells)
{
  for (std::uint32_t y = 0; y < cells.height; ++y)
  {
    if (!std::all_of(cells.row(y), cells.row(y) + cells.width, isBlankCell)) return false;
  }
  return true;
}

/// Returns the tiles that the whole frame of a field falls into, row by row.
std::vector<StoredCells> tilesOf(const DenseField& field)
{
  const RasterFrame& frame = field.frame;
  std::vector<StoredCells> tiles;
  for (std::uint32_t y = 0; y < frame.height; y += kSide)
  {
    for (std::uint32_t x = 0; x < frame.width; x += kSide)
    {
      tiles.push_back({x, y, std::min(kSide, frame.width - x), std::min(kSide, frame.height - y),
                       &field.at(x, y), frame.width});
    }
  }
  return tiles;
}

std::size_t cellCount(const RasterFrame& frame)
{
  return std::size_t{frame.width} * frame.height;
}
}  // namespace

std::vector<StoredCells> storedCells(const DenseField& field)
{
  const RasterFrame& frame = field.frame;
  if (!field.isTiled())
  {
    return {{0, 0, frame.width, frame.height, field.cells.data(), frame.width}};
  }
  const std::uint32_t columns = field.tileColumns();
  std::vector<StoredCells> stored;
  for (std::size_t k = 0; k < field.tiles.size(); ++k)
  {
    if (field.tiles[k] == 0) continue;
    const std::uint32_t x = static_cast<std::uint32_t>(k % columns) * kSide;
    const std::uint32_t y = static_cast<std::uint32_t>(k / columns) * kSide;
    stored.push_back({x, y, std::min(kSide, frame.width - x), std::min(kSide, frame.height - y),
                      &field.cells[field.tiles[k] * DenseField::kTileCells], kSide});
  }
  return stored;
}

DenseField tiledField(const RasterFrame& frame)
{
  DenseField field;
  field.frame = frame;
  field.tiles.assign(std::size_t{field.tileColumns()} * ((frame.height + kSide - 1) / kSide), 0);
  field.cells.resize(DenseField::kTileCells);
  return field;
}

void storeTile(DenseField& field, std::size_t tile, const StoredCells& cells)
{
  if (isBlank(cells)) return;
  const std::size_t first = field.cells.size();
  field.tiles[tile] = static_cast<std::uint32_t>(first / DenseField::kTileCells);
  field.cells.resize(first + DenseField::kTileCells);
  for (std::uint32_t y = 0; y < cells.height; ++y)
  {
    std::copy_n(cells.row(y), cells.width, &field.cells[first + std::size_t{y} * kSide]);
  }
}

DenseField inTilesWhereSparse(DenseField field, std::size_t most_whole)
{
  if (field.isTiled() || field.cells.size() <= most_whole) return field;
  const std::vector<StoredCells> tiles = tilesOf(field);
  const auto blank = static_cast<std::size_t>(std::count_if(
      tiles.begin(), tiles.end(), [](const StoredCells& tile) { return isBlank(tile); }));
  const std::size_t stored = (tiles.size() - blank + 1) * DenseField::kTileCells;
  const std::size_t all = cellCount(field.frame);
  if (2 * stored >= all && static_cast<double>(all) <= kMostCells) return field;
  DenseField tiled = tiledField(field.frame);
  tiled.free_area = field.free_area;
  tiled.wall_cells = field.wall_cells;
  tiled.cells.reserve(stored);
  for (std::size_t k = 0; k < tiles.size(); ++k) storeTile(tiled, k, tiles[k]);
  return tiled;
}

DenseField wholeField(const DenseField& field)
{
  if (!field.isTiled()) return field;
  if (const auto flaw = flawOf(field.frame)) throw std::invalid_argument(*flaw);
  DenseField whole;
  whole.frame = field.frame;
  whole.free_area = field.free_area;
  whole.wall_cells = field.wall_cells;
  whole.cells.resize(cellCount(field.frame));
  for (const StoredCells& stored : storedCells(field))
  {
    for (std::uint32_t y = 0; y < stored.height; ++y)
    {
      std::copy_n(stored.row(y), stored.width,
                  &whole.cells[std::size_t{stored.y + y} * field.frame.width + stored.x]);
    }
  }
  return whole;
}

ShrunkField shrunkField(const DenseField& field, std::uint32_t block)
{
  ShrunkField shrunk;
  shrunk.width = (field.frame.width + block - 1) / block;
  shrunk.height = (field.frame.height + block - 1) / block;
  shrunk.states.resize(std::size_t{shrunk.width} * shrunk.height, CellState::unknown);
  for (const StoredCells& stored : storedCells(field))
  {
    for (std::uint32_t y = 0; y < stored.height; ++y)
    {
      CellState* row = &shrunk.states[std::size_t{(stored.y + y) / block} * shrunk.width];
      for (std::uint32_t x = 0; x < stored.width; ++x)
      {
        CellState& state = row[(stored.x + x) / block];
        state = std::max(state, stored.row(y)[x].state());
      }
    }
  }
  return shrunk;
}
}  // namespace sigloc
