// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sigloc
{
/// The state of a raster cell. The numeric values are stored in `.sigmap` files.
/// \cite algorithm eq. (6.1), (6.2)
enum class CellState : std::uint8_t
{
  unknown = 0,
  free = 1,
  wall = 2,  ///< beams ended here
  solid_wall = 3,  ///< at least as many beams ended here as passed: it stops beams
};

/// True for wall and solid wall.
inline bool isWall(CellState state)
{
  return state >= CellState::wall;
}

/// A raster over the map plane, row by row from the lower left corner: cell (ix, iy) covers
/// [origin + resolution * i, origin + resolution * (i + 1)).
struct RasterFrame
{
  mrpt::math::TPoint2D origin;  ///< [m], lower left corner in the map frame
  double resolution = 0.05;  ///< [m]
  std::uint32_t width = 0;  ///< [cells]
  std::uint32_t height = 0;  ///< [cells]
};

/// The mean position of the returns of mapping scans in a wall cell. \cite algorithm eq. (6.12)
struct WallHits
{
  static constexpr double kUnit = 0.125;  ///< [cells] per unit of x and y
  static constexpr std::uint8_t kMostWeight = 7;
  std::int8_t x = 0;  ///< [kUnit] from the middle of the cell
  std::int8_t y = 0;  ///< [kUnit] from the middle of the cell
  std::uint8_t weight = 1;  ///< against other wall cells, 1 to kMostWeight
};

inline bool operator==(const WallHits& a, const WallHits& b)
{
  return a.x == b.x && a.y == b.y && a.weight == b.weight;
}

/// Occupancy as the dense field needs it, from the hit counts of mapping scans or from an occupancy
/// grid map.
struct OccupancyRaster
{
  RasterFrame frame;
  std::vector<CellState> cells;  ///< width * height
  /// width * height, used for wall cells. Where empty, walls are in the middle of their cells.
  std::vector<WallHits> hits;
};

/// One cell of the dense field, in three bytes: what is looked up at random should fit the cache.
class DenseCell
{
 public:
  static constexpr std::uint8_t kFar = 127;  ///< stands for all distances above those stored
  static constexpr std::uint8_t kMarked = 128;  ///< in code()

  DenseCell() = default;
  /// Makes a cell of a state, `distance` units from the nearest wall cell, kFar at most. Of a wall
  /// the distance is 0, and of other cells at least 1, whatever is given.
  explicit DenseCell(CellState state, std::uint8_t distance = kFar)
      : code_(isWall(state) ? 0 : clamped(distance))
  {
    if (state == CellState::free || state == CellState::solid_wall) code_ |= kMarked;
  }

  /// Returns the distance to the nearest wall cell, in units of DenseField::kDistanceUnit; kFar:
  /// farther away.
  std::uint8_t distance() const { return code_ & kFar; }
  CellState state() const { return stateOf(code_); }

  /// Returns the distance, with kMarked added where the cell is free or a solid wall.
  std::uint8_t code() const { return code_; }
  static CellState stateOf(std::uint8_t code)
  {
    const bool is_marked = code >= kMarked;
    if ((code & kFar) != 0) return is_marked ? CellState::free : CellState::unknown;
    return is_marked ? CellState::solid_wall : CellState::wall;
  }

  /// From the middle of the cell to the ridge of the nearest wall, in units of
  /// DenseField::kOffsetUnit. Used where the distance is not kFar.
  std::int8_t dx = 0;
  std::int8_t dy = 0;

 private:
  static std::uint8_t clamped(std::uint8_t distance)
  {
    if (distance == 0) return 1;
    return distance < kFar ? distance : kFar;
  }

  std::uint8_t code_ = kFar;
};
static_assert(sizeof(DenseCell) == 3, "a field has hundreds of cells a square metre");

/// Returns memory for cells, with a byte behind the last, so that each can be read as a word of
/// four bytes. It is on large pages where there is much of it. Throws std::bad_alloc.
void* allocateCells(std::size_t bytes);
void freeCells(void* cells) noexcept;

/// Memory of such cells.
template <class T>
struct CellAllocator
{
  using value_type = T;  // NOLINT(readability-identifier-naming): what allocators call it
  CellAllocator() = default;
  template <class U>
  // NOLINTNEXTLINE(google-explicit-constructor): allocators convert
  CellAllocator(const CellAllocator<U>& /*other*/)
  {
  }
  T* allocate(std::size_t n) { return static_cast<T*>(allocateCells(n * sizeof(T))); }
  void deallocate(T* cells, std::size_t /*n*/) noexcept { freeCells(cells); }
  friend bool operator==(const CellAllocator& /*a*/, const CellAllocator& /*b*/) { return true; }
  friend bool operator!=(const CellAllocator& /*a*/, const CellAllocator& /*b*/) { return false; }
};
using DenseCells = std::vector<DenseCell, CellAllocator<DenseCell>>;

/// Distance to, and direction of, the nearest wall everywhere on the map, for dense verification.
/// Plain data; see `buildDenseField`. Where most of a large frame is not mapped, only tiles with
/// something in them are stored. \cite algorithm eq. (6.3)
struct DenseField
{
  static constexpr double kDistanceUnit = 0.01;  ///< [m] per unit of DenseCell::distance()
  static constexpr double kOffsetUnit = 0.01;  ///< [m] per unit of DenseCell::dx and dy
  static constexpr std::uint32_t kTileSide = 64;  ///< [cells]
  static constexpr std::size_t kTileCells = std::size_t{kTileSide} * kTileSide;
  RasterFrame frame;
  /// width * height, or kTileCells for each stored tile, row by row in it.
  DenseCells cells;
  /// For each tile of the frame, row by row: its place among the stored ones. The first stored tile
  /// stands for all without anything in them. Empty where `cells` has the whole frame.
  std::vector<std::uint32_t> tiles;
  double free_area = 0;  ///< [m^2] known to be free
  std::uint32_t wall_cells = 0;

  bool isTiled() const { return !tiles.empty(); }
  /// Returns how many tiles lie side by side in the frame.
  std::uint32_t tileColumns() const
  {
    return frame.width / kTileSide + (frame.width % kTileSide != 0 ? 1 : 0);
  }
  /// Returns the cell in column `x` and row `y`, which must be in the frame.
  const DenseCell& at(std::size_t x, std::size_t y) const
  {
    if (tiles.empty()) return cells[y * frame.width + x];
    const std::size_t tile = tiles[y / kTileSide * tileColumns() + x / kTileSide];
    return cells[tile * kTileCells + y % kTileSide * kTileSide + x % kTileSide];
  }
};

/// Returns the cell with a point of the map frame [m], or null outside the field.
inline const DenseCell* cellAt(const DenseField& field, const mrpt::math::TPoint2D& point)
{
  const RasterFrame& frame = field.frame;
  const double x = std::floor((point.x - frame.origin.x) / frame.resolution);
  const double y = std::floor((point.y - frame.origin.y) / frame.resolution);
  if (!(x >= 0 && y >= 0 && x < frame.width && y < frame.height)) return nullptr;
  return &field.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
}

/// A rectangle of a field's cells.
struct StoredCells
{
  std::uint32_t x = 0;  ///< [cells] column of its lower left cell
  std::uint32_t y = 0;
  std::uint32_t width = 0;  ///< [cells]
  std::uint32_t height = 0;
  const DenseCell* first = nullptr;  ///< its lower left cell
  std::size_t stride = 0;  ///< [cells] from a row to the next

  const DenseCell* row(std::uint32_t k) const { return first + k * stride; }
};

/// Returns the rectangles that hold all cells with something in them: the whole frame, or the
/// stored tiles within it, row by row.
std::vector<StoredCells> storedCells(const DenseField& field);

/// Frames of at most so many cells are stored whole: what is looked up in them is often cached.
constexpr std::size_t kMostWholeCells = std::size_t{1} << 24U;

/// Returns the same field, in tiles where these take less than half of the memory and the whole
/// frame has more than `most_whole` cells. A field too large to be kept whole is put in tiles, too.
DenseField inTilesWhereSparse(DenseField field, std::size_t most_whole = kMostWholeCells);

/// Returns the least distance [m] to any wall of a cell whose distance is kFar. Distances are
/// stored up to 1.26 m and 127 cells.
double truncationDistance(double resolution);

/// Returns the distance [cells] along either axis beyond which a cell's state has no effect on a
/// cell of the dense field.
std::int32_t fieldReach(double resolution);

/// Returns the dense field of a raster. \cite algorithm eq. (6.3), (6.12)
/// Throws std::invalid_argument when the raster is empty, or the resolution is not within
/// [0.005 m, 1 m]. Also when the number of cells, or of hits if there are any, disagrees with the
/// frame, or the weight of hits is 0.
DenseField buildDenseField(const OccupancyRaster& raster);

/// Returns the raster of a field. It has the ridge of a wall cell as the position of its hits,
/// because a field does not store them. Throws std::invalid_argument for the frame of a field in
/// tiles that is too large for a raster.
OccupancyRaster rasterOf(const DenseField& field);
}  // namespace sigloc
