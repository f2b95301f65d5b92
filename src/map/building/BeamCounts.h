// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "map/map_values.h"
#include "sigloc/map/map_building.h"

namespace sigloc
{
/// A cell of an unbounded raster. It covers [anchor + resolution * x, anchor + resolution * (x +
/// 1)).
struct CellIndex
{
  std::int32_t x = 0;
  std::int32_t y = 0;
};

/// A rectangle of cells, from its lower left cell to the one beyond its upper right.
struct CellBox
{
  CellIndex low;
  CellIndex high;
  std::int32_t width() const { return high.x - low.x; }
  std::int32_t height() const { return high.y - low.y; }
};

inline CellBox unionOf(const CellBox& a, const CellBox& b)
{
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

inline CellBox intersection(const CellBox& a, const CellBox& b)
{
  return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)},
          {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y)}};
}

inline CellBox widened(const CellBox& box, std::int32_t by)
{
  return {{box.low.x - by, box.low.y - by}, {box.high.x + by, box.high.y + by}};
}

/// Counts, for each cell, the scans that hit it and the beams that hit and passed it. All laser
/// scans of one step count as one scan. Cells are kept in tiles that are made where beams go, so
/// memory grows with the area seen. \cite algorithm eq. (6.1), (6.2)
class BeamCounts
{
 public:
  static constexpr std::int32_t kTileSide = 32;

  struct Count
  {
    std::uint32_t last_scan = 0;  ///< last scan that hit it; 0: none, or one before restore()
    std::uint16_t hits = 0;  ///< beams that ended here; all counts saturate
    std::uint16_t passes = 0;  ///< beams that passed
    std::uint16_t scans = 0;  ///< scans that hit it
    /// Sums of the positions of the hits, from the middle of the cell, in kPlaceUnit.
    std::int32_t sum_x = 0, sum_y = 0;
  };
  static constexpr double kPlaceUnit = 1.0 / 64;  ///< [cells]
  static constexpr std::size_t kCellsOfTile = std::size_t{kTileSide} * kTileSide;

  /// The counts of a square of cells, by their index, row by row. Beams pass nearly all cells and
  /// end in few, so that only cells with a hit have more than the count of passes.
  class Tile
  {
   public:
    Count count(std::size_t cell) const;
    void set(std::size_t cell, const Count& count);
    std::uint16_t& passes(std::size_t cell) { return passes_[cell]; }
    std::uint16_t passes(std::size_t cell) const { return passes_[cell]; }
    std::uint16_t scans(std::size_t cell) const
    {
      return isHit(cell) ? hits_[indexOf(cell)].scans : std::uint16_t{0};
    }

    bool changed = false;

   private:
    friend class BeamCounts;
    struct Hits
    {
      std::uint32_t last_scan = 0;
      std::int32_t sum_x = 0, sum_y = 0;
      std::uint16_t hits = 0;
      std::uint16_t scans = 0;
    };
    /// Returns the hits of a cell; makes them where there were none.
    Hits& hitsAt(std::size_t cell);

    bool isHit(std::size_t cell) const { return (hit_[cell / 64] >> cell % 64 & 1U) != 0; }
    /// Returns the index in hits_ of a cell, or the one it would get.
    std::size_t indexOf(std::size_t cell) const
    {
      const std::uint64_t before = hit_[cell / 64] & ((std::uint64_t{1} << cell % 64) - 1);
      return hits_before_[cell / 64] + std::bitset<64>(before).count();
    }

    std::array<std::uint16_t, kCellsOfTile> passes_{};
    std::array<std::uint64_t, kCellsOfTile / 64> hit_{};  // a bit for each cell with a hit
    std::array<std::uint16_t, kCellsOfTile / 64> hits_before_{};  // bits before each 64 of them
    std::vector<Hits> hits_;  // of the cells with a hit, in their order
  };
  /// Box around all that was counted [m].
  struct Extent
  {
    mrpt::math::TPoint2D low{1e12, 1e12};
    mrpt::math::TPoint2D high{-1e12, -1e12};
    void add(const mrpt::math::TPoint2D& p);
    bool empty() const { return low.x > high.x; }
  };

  /// `resolution` is in metres. One cell has its lower left corner at `anchor` [m]. The box of all
  /// that is counted may have `most_cells`.
  explicit BeamCounts(double resolution, const mrpt::math::TPoint2D& anchor = {0, 0},
                      double most_cells = kMostCells);

  /// Counts the beams of one scan up to `max_range` [m]. Throws std::invalid_argument, with nothing
  /// counted, for a pose that is not finite or where the area seen would become too large.
  void add(const PosedScans& posed, double max_range);

  /// The present state of each cell of a tile, row by row; unknown where there is no tile.
  /// Eq. (6.1), (6.2), (6.12)
  struct TileCells
  {
    std::array<CellState, kCellsOfTile> states{};
    std::array<WallHits, kCellsOfTile> hits{};  ///< of walls
  };
  TileCells cellsOf(const CellIndex& name, std::uint32_t min_scans) const;

  /// Returns the box of all that was counted, with a border. Must not be called on an empty extent.
  CellBox box() const;
  RasterFrame frameOf(const CellBox& box) const;
  /// Returns all cells of a box.
  OccupancyRaster raster(const CellBox& box, std::uint32_t min_scans) const;

  /// Forgets the tiles of which all cells lie below row `y`, and gives their memory back to the
  /// system. What is forgotten is unknown.
  void forgetBelow(std::int32_t y);

  /// True when cells may have changed since `takeChangedTiles` was called last.
  bool changed() const { return !changed_.empty(); }
  /// Returns the lower left cells of the tiles in which cells may have changed, in order.
  std::vector<CellIndex> takeChangedTiles();

  bool empty() const { return extent_.empty(); }
  double resolution() const { return resolution_; }
  const mrpt::math::TPoint2D& anchor() const { return anchor_; }
  std::uint64_t cellsCounted() const { return cells_counted_; }  ///< work done, in cells

  // For storing. Tiles are named by their lower left cell.
  const Extent& extent() const { return extent_; }
  std::vector<CellIndex> tileNames() const;  ///< in order
  const Tile& tile(const CellIndex& name) const;
  /// Restores stored counts. Throws std::invalid_argument for an extent too large for a raster, a
  /// name that no tile within it can have, or counts that no scans can cause.
  void restore(const Extent& extent, const CellIndex& name, const Tile& tile);

 private:
  /// The tile found last, because a beam stays in one for many cells.
  struct Cursor
  {
    std::uint64_t key = ~0ULL;
    Tile* tile = nullptr;
  };
  bool isHeld(const Extent& extent) const;
  CellBox boxOf(const Extent& extent) const;
  Cursor enterTile(const CellIndex& cell);
  void markChanged(std::uint64_t key, Tile& tile);
  void touchNeighbours(const CellIndex& hit);
  void addBeam(const mrpt::math::TPoint2D& origin, const mrpt::math::TPoint2D& end, Cursor& cursor);
  void fillTile(const CellIndex& name, std::uint32_t min_scans, const CellIndex& low,
                OccupancyRaster& raster) const;
  bool hitOftenAround(const CellIndex& cell, std::uint32_t min_scans) const;

  double resolution_;
  mrpt::math::TPoint2D anchor_;
  double most_cells_;
  std::unordered_map<std::uint64_t, Tile> tiles_;
  std::vector<std::uint64_t> changed_;  // keys of changed tiles, each once
  Extent extent_;
  std::uint32_t scan_ = 0;
  std::uint64_t cells_counted_ = 0;
};
}  // namespace sigloc
