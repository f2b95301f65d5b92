// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/counted_field.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "map/field_tiles.h"

namespace sigloc
{
namespace
{
constexpr std::int32_t kLeastRows = 128;  // of a strip, or its margins would cost too much

/// Appends rows of the solved window to the field, and counts their cells.
void takeRows(const DenseField& window, std::size_t first, std::size_t rows, DenseField& field,
              std::size_t& free_cells)
{
  const std::size_t width = field.frame.width;
  const auto from = window.cells.begin() + static_cast<std::ptrdiff_t>(first * width);
  const auto end = from + static_cast<std::ptrdiff_t>(rows * width);
  for (auto cell = from; cell != end; ++cell)
  {
    free_cells += cell->state() == CellState::free ? 1U : 0U;
    field.wall_cells += isWall(cell->state()) ? 1U : 0U;
  }
  field.cells.insert(field.cells.end(), from, end);
}

/// Returns the field with its whole frame, solved strip by strip.
DenseField solvedInStrips(BeamCounts& counts, std::uint32_t min_scans, std::int32_t strip_cells)
{
  const CellBox box = counts.box();
  const std::int32_t reach = fieldReach(counts.resolution());
  const std::int32_t rows = std::max(kLeastRows, strip_cells / box.width());
  DenseField field;
  field.frame = counts.frameOf(box);
  field.cells.reserve(std::size_t{field.frame.width} * field.frame.height);
  std::size_t free_cells = 0;
  for (std::int32_t low = box.low.y; low < box.high.y; low += rows)
  {
    const std::int32_t high = std::min(low + rows, box.high.y);
    const CellBox strip{{box.low.x, low}, {box.high.x, high}};
    const CellBox window = intersection(widened(strip, reach), box);
    const auto below = static_cast<std::size_t>(low - window.low.y);
    takeRows(buildDenseField(counts.raster(window, min_scans)), below,
             static_cast<std::size_t>(high - low), field, free_cells);
    counts.forgetBelow(high - reach - 1);  // a wall may depend on the row below
  }
  field.free_area = static_cast<double>(free_cells) * counts.resolution() * counts.resolution();
  return field;
}

/// Solves the field in tiles: only those that a counted cell is in or near.
class TileSolver
{
 public:
  TileSolver(BeamCounts& counts, std::uint32_t min_scans)
      : counts_(counts),
        min_scans_(min_scans),
        box_(counts.box()),
        reach_(fieldReach(counts.resolution())),
        field_(tiledField(counts.frameOf(box_))),
        columns_(static_cast<std::int32_t>(field_.tileColumns())),
        rows_(static_cast<std::int32_t>(field_.tiles.size()) / columns_),
        wanted_(field_.tiles.size(), false)
  {
    for (const CellIndex& name : counts.tileNames()) want(name);
  }

  /// Whether the tiles take less than half of the memory of the whole frame.
  bool isWorthIt() const
  {
    const auto tiles = static_cast<std::size_t>(std::count(wanted_.begin(), wanted_.end(), true));
    return 2 * (tiles + 1) * DenseField::kTileCells <
           std::size_t{field_.frame.width} * field_.frame.height;
  }

  /// Solves runs of tiles that lie side by side in bands of tile rows.
  DenseField solve()
  {
    for (std::int32_t row = 0; row < rows_; row += kBandRows)
    {
      const std::int32_t row_end = std::min(row + kBandRows, rows_);
      std::int32_t column = 0;
      while (column < columns_)
      {
        std::int32_t end = column;
        while (end < columns_ && isWanted(end, row, row_end)) ++end;
        if (end > column) solveTiles({{column, row}, {end, row_end}});
        column = end + 1;
      }
      counts_.forgetBelow(box_.low.y + row_end * kSide - reach_ - 1);
    }
    field_.cells.shrink_to_fit();
    const double resolution = counts_.resolution();
    field_.free_area = static_cast<double>(free_cells_) * resolution * resolution;
    return std::move(field_);
  }

 private:
  static constexpr auto kSide = static_cast<std::int32_t>(DenseField::kTileSide);
  static constexpr std::int32_t kBandRows = 4;

  std::size_t indexOf(std::int32_t column, std::int32_t row) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  /// Marks the tiles whose cells can depend on those of a tile of the counts.
  void want(const CellIndex& name)
  {
    const auto tile_of = [](std::int32_t cell, std::int32_t tiles)
    { return std::clamp(cell, 0, tiles * kSide - 1) / kSide; };
    const std::int32_t x = name.x - box_.low.x;
    const std::int32_t y = name.y - box_.low.y;
    const std::int32_t last = BeamCounts::kTileSide - 1 + reach_;
    for (std::int32_t row = tile_of(y - reach_, rows_); row <= tile_of(y + last, rows_); ++row)
    {
      for (std::int32_t column = tile_of(x - reach_, columns_);
           column <= tile_of(x + last, columns_); ++column)
      {
        wanted_[indexOf(column, row)] = true;
      }
    }
  }

  bool isWanted(std::int32_t column, std::int32_t row, std::int32_t row_end) const
  {
    bool wanted = false;
    for (; row < row_end; ++row) wanted = wanted || wanted_[indexOf(column, row)];
    return wanted;
  }

  /// Solves a rectangle of tiles from the walls in and around it.
  void solveTiles(const CellBox& tiles)
  {
    const CellBox cells{{box_.low.x + tiles.low.x * kSide, box_.low.y + tiles.low.y * kSide},
                        {box_.low.x + tiles.high.x * kSide, box_.low.y + tiles.high.y * kSide}};
    const CellBox window = intersection(widened(cells, reach_), box_);
    const DenseField solved = buildDenseField(counts_.raster(window, min_scans_));
    for (std::int32_t row = tiles.low.y; row < tiles.high.y; ++row)
    {
      for (std::int32_t column = tiles.low.x; column < tiles.high.x; ++column)
      {
        take(solved, window.low, column, row);
      }
    }
  }

  void take(const DenseField& solved, const CellIndex& window, std::int32_t column,
            std::int32_t row)
  {
    const CellIndex low{box_.low.x + column * kSide, box_.low.y + row * kSide};
    const StoredCells tile{0,
                           0,
                           static_cast<std::uint32_t>(std::min(kSide, box_.high.x - low.x)),
                           static_cast<std::uint32_t>(std::min(kSide, box_.high.y - low.y)),
                           &solved.at(static_cast<std::size_t>(low.x - window.x),
                                      static_cast<std::size_t>(low.y - window.y)),
                           solved.frame.width};
    for (std::uint32_t y = 0; y < tile.height; ++y)
    {
      for (const DenseCell* cell = tile.row(y); cell != tile.row(y) + tile.width; ++cell)
      {
        free_cells_ += cell->state() == CellState::free ? 1U : 0U;
        field_.wall_cells += isWall(cell->state()) ? 1U : 0U;
      }
    }
    storeTile(field_, indexOf(column, row), tile);
  }

  BeamCounts& counts_;
  std::uint32_t min_scans_;
  CellBox box_;
  std::int32_t reach_;  // [cells]
  DenseField field_;
  std::int32_t columns_, rows_;  // [tiles]
  std::vector<bool> wanted_;
  std::size_t free_cells_ = 0;
};
}  // namespace

DenseField denseFieldOf(BeamCounts counts, std::uint32_t min_scans, std::int32_t strip_cells,
                        std::size_t most_whole)
{
  const RasterFrame frame = counts.frameOf(counts.box());
  if (std::size_t{frame.width} * frame.height > most_whole)
  {
    TileSolver solver(counts, min_scans);
    if (solver.isWorthIt()) return solver.solve();
  }
  return inTilesWhereSparse(solvedInStrips(counts, min_scans, strip_cells), most_whole);
}

OccupancyRaster rasterFromScans(const std::vector<PosedScans>& scans,
                                const MapBuildingOptions& options)
{
  checkOptions(options);
  BeamCounts counts(options.raster_resolution);
  for (const PosedScans& posed : scans) counts.add(posed, options.raster_range);
  if (counts.empty())
    throw std::invalid_argument("no scan has a return that is valid and near enough");
  return counts.raster(counts.box(), options.min_hits);
}
}  // namespace sigloc
