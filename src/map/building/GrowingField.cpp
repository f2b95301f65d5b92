// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/GrowingField.h"

#include <algorithm>
#include <utility>

#include "map/field_tiles.h"

namespace sigloc
{
namespace
{
constexpr std::int32_t kLeastMargin = 64;  // [cells] least margin of unknown cells to grow into
constexpr std::int32_t kBlock = 32;  // [cells] side of the smallest box that is solved

std::int64_t freeCellsOf(const DenseField& field)
{
  return std::count_if(field.cells.begin(), field.cells.end(),
                       [](const DenseCell& cell) { return cell.state() == CellState::free; });
}

CellBox boxOf(const RasterFrame& frame, const CellIndex& low)
{
  return {low,
          {low.x + static_cast<std::int32_t>(frame.width),
           low.y + static_cast<std::int32_t>(frame.height)}};
}

bool isWithin(const CellBox& box, std::int32_t x, std::int32_t y)
{
  return x >= box.low.x && x < box.high.x && y >= box.low.y && y < box.high.y;
}

/// Rounds down, for negative numbers too.
std::int32_t blockOf(std::int32_t cell)
{
  return cell >= 0 ? cell / kBlock : -((kBlock - 1 - cell) / kBlock);
}

/// Returns boxes that cover the cells, each once: rows of neighbours, joined with equally wide rows
/// above them.
std::vector<CellBox> boxesOf(std::vector<CellIndex> cells)
{
  const auto order = [](const CellIndex& c) { return std::make_pair(c.y, c.x); };
  const auto before = [&](const CellIndex& a, const CellIndex& b) { return order(a) < order(b); };
  const auto same = [&](const CellIndex& a, const CellIndex& b) { return order(a) == order(b); };
  std::sort(cells.begin(), cells.end(), before);
  cells.erase(std::unique(cells.begin(), cells.end(), same), cells.end());
  std::vector<CellBox> boxes;
  for (std::size_t i = 0; i < cells.size();)
  {
    const CellIndex first = cells[i];
    std::int32_t count = 0;
    while (i < cells.size() && same(cells[i], {first.x + count, first.y}))
    {
      ++count;
      ++i;
    }
    const CellBox row{first, {first.x + count, first.y + 1}};
    const auto below = std::find_if(
        boxes.begin(), boxes.end(),
        [&](const CellBox& box)
        { return box.high.y == row.low.y && box.low.x == row.low.x && box.high.x == row.high.x; });
    if (below == boxes.end())
    {
      boxes.push_back(row);
    }
    else
    {
      ++below->high.y;
    }
  }
  return boxes;
}
}  // namespace

GrowingField::GrowingField(const DenseField& base)
    : field_(wholeField(base)),
      hits_(rasterOf(field_).hits),
      box_(boxOf(field_.frame, {0, 0})),
      tight_(box_),
      tight_frame_(field_.frame),
      free_cells_(freeCellsOf(field_))
{
}

void GrowingField::update(BeamCounts& counts, std::uint32_t min_scans)
{
  if (!counts.changed()) return;
  if (field_.cells.empty())
  {
    counts.takeChangedTiles();
    OccupancyRaster raster = counts.raster(counts.box(), min_scans);
    field_ = buildDenseField(raster);
    hits_ = std::move(raster.hits);
    tight_ = box_ = counts.box();
    tight_frame_ = field_.frame;
    free_cells_ = freeCellsOf(field_);
    cells_solved_ += field_.cells.size();
    return;
  }
  growTo(counts.box(), counts);
  std::vector<CellBox> changed;
  for (const CellIndex& name : counts.takeChangedTiles())
  {
    CellBox box{};
    if (takeCells(name, counts.cellsOf(name, min_scans), box)) changed.push_back(box);
  }
  solveAround(changed);
  const double r = field_.frame.resolution;
  field_.free_area = static_cast<double>(free_cells_) * r * r;
}

/// Enlarges the field with a margin in proportion to its size, so that copying is cheap on average.
void GrowingField::growTo(const CellBox& wanted, const BeamCounts& counts)
{
  tight_ = unionOf(tight_, wanted);
  tight_frame_ = counts.frameOf(tight_);
  CellBox grown = unionOf(box_, tight_);
  const std::int32_t margin_x = std::max(kLeastMargin, grown.width() / 4);
  const std::int32_t margin_y = std::max(kLeastMargin, grown.height() / 4);
  if (grown.low.x < box_.low.x) grown.low.x -= margin_x;
  if (grown.low.y < box_.low.y) grown.low.y -= margin_y;
  if (grown.high.x > box_.high.x) grown.high.x += margin_x;
  if (grown.high.y > box_.high.y) grown.high.y += margin_y;
  if (grown.width() == box_.width() && grown.height() == box_.height()) return;

  DenseField larger;
  larger.frame = counts.frameOf(grown);
  larger.wall_cells = field_.wall_cells;
  larger.cells.resize(std::size_t{larger.frame.width} * larger.frame.height);
  std::vector<WallHits> larger_hits(larger.cells.size());
  for (std::int32_t y = box_.low.y; y < box_.high.y; ++y)
  {
    const std::size_t row = indexOf(box_.low.x, y);
    const std::size_t first = static_cast<std::size_t>(y - grown.low.y) * larger.frame.width +
                              static_cast<std::size_t>(box_.low.x - grown.low.x);
    std::copy_n(&field_.cells[row], box_.width(), &larger.cells[first]);
    std::copy_n(&hits_[row], box_.width(), &larger_hits[first]);
  }
  field_ = std::move(larger);
  hits_ = std::move(larger_hits);
  box_ = grown;
}

void GrowingField::setState(DenseCell& cell, CellState state)
{
  if (cell.state() == CellState::free) --free_cells_;
  if (state == CellState::free) ++free_cells_;
  if (isWall(cell.state())) --field_.wall_cells;
  if (isWall(state)) ++field_.wall_cells;
  const DenseCell before = cell;
  cell = DenseCell(state, before.distance());
  cell.dx = before.dx;
  cell.dy = before.dy;
}

/// Takes over the cells of a tile. Returns true, and the box of changed cells, when walls have
/// come, gone or been hit at another position.
bool GrowingField::takeCells(const CellIndex& first, const BeamCounts::TileCells& tile,
                             CellBox& changed)
{
  bool any = false;
  std::size_t i = 0;
  for (std::int32_t y = first.y; y < first.y + BeamCounts::kTileSide; ++y)
  {
    for (std::int32_t x = first.x; x < first.x + BeamCounts::kTileSide; ++x, ++i)
    {
      // The tiles at the border extend beyond the field.
      if (tile.states[i] == CellState::unknown || !isWithin(box_, x, y)) continue;
      const std::size_t k = indexOf(x, y);
      DenseCell& cell = field_.cells[k];
      if (cell.state() == tile.states[i] && hits_[k] == tile.hits[i]) continue;
      const bool moves =
          isWall(cell.state()) != isWall(tile.states[i]) || !(hits_[k] == tile.hits[i]);
      setState(cell, tile.states[i]);
      hits_[k] = tile.hits[i];
      if (!moves) continue;
      const CellBox own{{x, y}, {x + 1, y + 1}};
      changed = any ? unionOf(changed, own) : own;
      any = true;
    }
  }
  return any;
}

/// Solves the blocks that a change affects, neighbouring ones together, because each box that is
/// solved also costs a margin around it.
void GrowingField::solveAround(const std::vector<CellBox>& changed)
{
  const std::int32_t reach = fieldReach(field_.frame.resolution);
  std::vector<CellIndex> blocks;
  for (const CellBox& box : changed)
  {
    const CellBox reached = intersection(widened(box, reach), box_);
    for (std::int32_t y = blockOf(reached.low.y); y <= blockOf(reached.high.y - 1); ++y)
    {
      for (std::int32_t x = blockOf(reached.low.x); x <= blockOf(reached.high.x - 1); ++x)
      {
        blocks.push_back({x, y});
      }
    }
  }
  for (const CellBox& box : boxesOf(std::move(blocks)))
  {
    const CellBox cells{{box.low.x * kBlock, box.low.y * kBlock},
                        {box.high.x * kBlock, box.high.y * kBlock}};
    solve(intersection(cells, box_));
  }
}

/// Solves a box anew from the walls in and around it.
void GrowingField::solve(const CellBox& box)
{
  const CellBox window = intersection(widened(box, fieldReach(field_.frame.resolution)), box_);
  OccupancyRaster raster;
  raster.frame.resolution = field_.frame.resolution;
  raster.frame.width = static_cast<std::uint32_t>(window.width());
  raster.frame.height = static_cast<std::uint32_t>(window.height());
  raster.cells.reserve(std::size_t{raster.frame.width} * raster.frame.height);
  raster.hits.reserve(raster.cells.capacity());
  for (std::int32_t y = window.low.y; y < window.high.y; ++y)
  {
    for (std::int32_t x = window.low.x; x < window.high.x; ++x)
    {
      raster.cells.push_back(field_.cells[indexOf(x, y)].state());
      raster.hits.push_back(hits_[indexOf(x, y)]);
    }
  }
  const DenseField solved = buildDenseField(raster);
  cells_solved_ += solved.cells.size();
  for (std::int32_t y = box.low.y; y < box.high.y; ++y)
  {
    const DenseCell* row =
        &solved.cells[static_cast<std::size_t>(y - window.low.y) * solved.frame.width +
                      static_cast<std::size_t>(box.low.x - window.low.x)];
    std::copy_n(row, box.width(), &field_.cells[indexOf(box.low.x, y)]);
  }
}

DenseField GrowingField::cropped() const
{
  DenseField field;
  field.frame = tight_frame_;
  field.free_area = field_.free_area;
  field.wall_cells = field_.wall_cells;
  field.cells.reserve(std::size_t{field.frame.width} * field.frame.height);
  for (std::int32_t y = tight_.low.y; y < tight_.high.y; ++y)
  {
    const auto row = field_.cells.begin() +
                     static_cast<std::ptrdiff_t>(y - box_.low.y) * field_.frame.width +
                     (tight_.low.x - box_.low.x);
    field.cells.insert(field.cells.end(), row, row + tight_.width());
  }
  return field;
}
}  // namespace sigloc
