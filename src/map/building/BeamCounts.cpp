// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/BeamCounts.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "geometry/cell_key.h"
#include "map/map_values.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr std::uint16_t kSolidScans = 2;  // least scans that hit a solid wall, eq. (6.2)
constexpr double kBorder = 1.5;  // [m] around the outermost return
constexpr double kMaxIndex = 1e9;  // bound of a cell's index, in either direction
constexpr std::int32_t kTile = BeamCounts::kTileSide;

/// Calls `visit(sensor origin, end point)` in the map frame for every valid return within range.
template <class Visit>
void forEachReturn(const PosedScans& posed, double max_range, Visit&& visit)
{
  for (const LaserScan& scan : posed.scans)
  {
    const mrpt::math::TPose2D map_from_sensor = posed.map_from_robot + scan.robot_from_sensor;
    const TPoint2D origin(map_from_sensor.x, map_from_sensor.y);
    if (!std::isfinite(origin.x) || !std::isfinite(origin.y) || !std::isfinite(map_from_sensor.phi))
    {
      throw std::invalid_argument("the pose of a scan is not finite");
    }
    for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    {
      const double range = static_cast<double>(scan.ranges[i]);
      if (scan.valid[i] == 0 || !std::isfinite(range) || range <= 0 || range > max_range) continue;
      const double angle =
          map_from_sensor.phi + scan.first_angle + static_cast<double>(i) * scan.angle_step;
      visit(origin,
            TPoint2D(origin.x + range * std::cos(angle), origin.y + range * std::sin(angle)));
    }
  }
}

void increase(std::uint16_t& count)
{
  if (count < 65535) ++count;
}

/// Rounds down a number that is known to fit, which saves a function call for every cell.
std::int32_t roundDown(double value)
{
  const auto truncated = static_cast<std::int32_t>(value);
  return value < truncated ? truncated - 1 : truncated;
}

CellIndex cellAt(const TPoint2D& p, const TPoint2D& anchor, double resolution)
{
  return {roundDown((p.x - anchor.x) / resolution), roundDown((p.y - anchor.y) / resolution)};
}

/// Rounds down, for negative numbers too.
std::int32_t tileOf(std::int32_t cell)
{
  return cell >> 5;
}
static_assert(kTile == 1 << 5);

std::int32_t firstOfTile(std::int32_t cell)
{
  return tileOf(cell) * kTile;
}

std::uint64_t keyOf(const CellIndex& cell)
{
  return cellKey(tileOf(cell.x), tileOf(cell.y));
}

CellIndex nameOf(std::uint64_t key)
{
  return {xOfCell(key) * kTile, yOfCell(key) * kTile};
}

std::size_t indexInTile(const CellIndex& cell)
{
  return static_cast<std::size_t>((cell.y & (kTile - 1)) * kTile + (cell.x & (kTile - 1)));
}

/// Returns the position of `p` in a cell along one axis, from its middle, in
/// BeamCounts::kPlaceUnit.
std::int32_t placeInCell(double p, double anchor, double resolution, std::int32_t cell)
{
  const double cells = (p - anchor) / resolution - cell - 0.5;
  return static_cast<std::int32_t>(std::lround(cells / BeamCounts::kPlaceUnit));
}

/// True for counts that scans can cause: every scan that hit has at least one beam that ended in
/// the cell.
bool isPossible(const BeamCounts::Count& count)
{
  const double most = 0.5 / BeamCounts::kPlaceUnit * count.hits;
  return count.scans <= count.hits && std::abs(static_cast<double>(count.sum_x)) <= most &&
         std::abs(static_cast<double>(count.sum_y)) <= most;
}

/// Returns the mean position and the weight of the hits of a cell that was hit. Eq. (6.12)
WallHits hitsOf(const BeamCounts::Count& count)
{
  const auto mean = [&](std::int32_t sum)
  {
    const double units = sum * (BeamCounts::kPlaceUnit / WallHits::kUnit) / count.hits;
    return static_cast<std::int8_t>(std::lround(units));
  };
  const auto weight = std::min<std::uint16_t>(count.scans, WallHits::kMostWeight);
  return {mean(count.sum_x), mean(count.sum_y), static_cast<std::uint8_t>(weight)};
}

bool comesFirst(const CellIndex& a, const CellIndex& b)
{
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}
}  // namespace

void BeamCounts::Extent::add(const TPoint2D& p)
{
  low = {std::min(low.x, p.x), std::min(low.y, p.y)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y)};
}

BeamCounts::BeamCounts(double resolution, const TPoint2D& anchor, double most_cells)
    : resolution_(resolution), anchor_(anchor), most_cells_(most_cells)
{
}

/// Whether a field can be made of the extent; false where it is not finite.
bool BeamCounts::isHeld(const Extent& extent) const
{
  const TPoint2D size = extent.high - extent.low;
  const double border = 2 * kBorder;
  const double cells = (size.x + border) * (size.y + border) / (resolution_ * resolution_);
  const TPoint2D low = extent.low - anchor_;
  const TPoint2D high = extent.high - anchor_;
  const double farthest =
      std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)});
  return size.x >= 0 && size.y >= 0 && cells < most_cells_ && farthest / resolution_ < kMaxIndex;
}

void BeamCounts::add(const PosedScans& posed, double max_range)
{
  Extent extent = extent_;
  forEachReturn(posed, max_range,
                [&](const TPoint2D& origin, const TPoint2D& end)
                {
                  extent.add(origin);
                  extent.add(end);
                });
  if (extent.empty()) return;
  if (!isHeld(extent)) throw std::invalid_argument("the scans spread over too large an area");
  extent_ = extent;
  ++scan_;
  Cursor cursor;
  forEachReturn(posed, max_range,
                [&](const TPoint2D& origin, const TPoint2D& end) { addBeam(origin, end, cursor); });
}

BeamCounts::Cursor BeamCounts::enterTile(const CellIndex& cell)
{
  const std::uint64_t key = keyOf(cell);
  const Cursor cursor{key, &tiles_[key]};
  markChanged(key, *cursor.tile);
  return cursor;
}

void BeamCounts::markChanged(std::uint64_t key, Tile& tile)
{
  if (tile.changed) return;
  tile.changed = true;
  changed_.push_back(key);
}

/// A beam passes the cells up to one cell before its end, and hits the cell at its end.
void BeamCounts::addBeam(const TPoint2D& origin, const TPoint2D& end, Cursor& cursor)
{
  const TPoint2D beam = end - origin;
  const double length = beam.norm();
  const double resolution = resolution_;
  const TPoint2D anchor = anchor_;
  const auto tile_of = [&](const CellIndex& cell) -> Tile&
  {
    if (keyOf(cell) != cursor.key || cursor.tile == nullptr) cursor = enterTile(cell);
    return *cursor.tile;
  };
  const auto steps = static_cast<std::int64_t>(length / resolution - 1.0);
  for (std::int64_t k = 0; k < steps; ++k)
  {
    const double share = static_cast<double>(k) * resolution / length;
    const CellIndex passed = cellAt(origin + beam * share, anchor, resolution);
    increase(tile_of(passed).passes(indexInTile(passed)));
  }
  cells_counted_ += static_cast<std::uint64_t>(std::max<std::int64_t>(steps, 0)) + 1;
  const CellIndex hit_cell = cellAt(end, anchor, resolution);
  Tile::Hits& hit = tile_of(hit_cell).hitsAt(indexInTile(hit_cell));
  if (hit.hits < 65535)  // where the count saturates, the mean stays
  {
    hit.sum_x += placeInCell(end.x, anchor.x, resolution, hit_cell.x);
    hit.sum_y += placeInCell(end.y, anchor.y, resolution, hit_cell.y);
  }
  increase(hit.hits);
  if (hit.last_scan == scan_) return;
  hit.last_scan = scan_;
  increase(hit.scans);
  touchNeighbours(hit_cell);
}

/// Marks the tiles of the neighbours as changed. A hit may turn a neighbour into wall, eq. (6.1),
/// but only one that was hit itself, so its tile exists.
void BeamCounts::touchNeighbours(const CellIndex& hit)
{
  const auto at_border = [](std::int32_t i)
  { return (i & (kTile - 1)) == 0 || (i & (kTile - 1)) == kTile - 1; };
  if (!at_border(hit.x) && !at_border(hit.y)) return;
  for (const std::int32_t dy : {-1, 1})
  {
    for (const std::int32_t dx : {-1, 1})
    {
      for (const CellIndex& beside : {CellIndex{hit.x + dx, hit.y}, CellIndex{hit.x, hit.y + dy},
                                      CellIndex{hit.x + dx, hit.y + dy}})
      {
        const auto neighbour = tiles_.find(keyOf(beside));
        if (neighbour != tiles_.end()) markChanged(neighbour->first, neighbour->second);
      }
    }
  }
}

/// True when a cell was hit often enough together with its neighbours, because a far wall spreads
/// over two or three cells. Eq. (6.1)
bool BeamCounts::hitOftenAround(const CellIndex& cell, std::uint32_t min_scans) const
{
  std::uint32_t sum = 0;
  for (std::int32_t y = cell.y - 1; y <= cell.y + 1; ++y)
  {
    for (std::int32_t x = cell.x - 1; x <= cell.x + 1; ++x)
    {
      const auto tile = tiles_.find(keyOf({x, y}));
      if (tile != tiles_.end()) sum += tile->second.scans(indexInTile({x, y}));
    }
  }
  return sum >= min_scans;
}

BeamCounts::TileCells BeamCounts::cellsOf(const CellIndex& name, std::uint32_t min_scans) const
{
  TileCells cells;
  const auto tile = tiles_.find(keyOf(name));
  if (tile == tiles_.end()) return cells;
  const auto state_of = [&](const CellIndex& cell, const Count& count)
  {
    const bool wall =
        count.scans > 0 && (count.scans >= min_scans || hitOftenAround(cell, min_scans));
    if (!wall) return count.passes > 0 ? CellState::free : CellState::unknown;
    const bool solid = count.scans >= kSolidScans && count.hits >= count.passes;
    return solid ? CellState::solid_wall : CellState::wall;
  };
  for (std::size_t i = 0; i < kCellsOfTile; ++i)
  {
    const CellIndex cell{name.x + static_cast<std::int32_t>(i) % kTile,
                         name.y + static_cast<std::int32_t>(i) / kTile};
    const Count count = tile->second.count(i);
    cells.states[i] = state_of(cell, count);
    if (isWall(cells.states[i])) cells.hits[i] = hitsOf(count);
  }
  return cells;
}

CellBox BeamCounts::box() const
{
  return boxOf(extent_);
}

CellBox BeamCounts::boxOf(const Extent& extent) const
{
  const TPoint2D border(kBorder, kBorder);
  const TPoint2D high = extent.high + border - anchor_;
  return {cellAt(extent.low - border, anchor_, resolution_),
          {static_cast<std::int32_t>(std::ceil(high.x / resolution_)),
           static_cast<std::int32_t>(std::ceil(high.y / resolution_))}};
}

RasterFrame BeamCounts::frameOf(const CellBox& box) const
{
  RasterFrame frame;
  frame.resolution = resolution_;
  frame.origin = {anchor_.x + resolution_ * box.low.x, anchor_.y + resolution_ * box.low.y};
  frame.width = static_cast<std::uint32_t>(box.width());
  frame.height = static_cast<std::uint32_t>(box.height());
  return frame;
}

/// Copies the cells of a tile into a raster. The tiles at the border extend beyond its frame.
void BeamCounts::fillTile(const CellIndex& name, std::uint32_t min_scans, const CellIndex& low,
                          OccupancyRaster& raster) const
{
  const RasterFrame& frame = raster.frame;
  const TileCells tile = cellsOf(name, min_scans);
  for (std::size_t i = 0; i < tile.states.size(); ++i)
  {
    const std::int64_t column = name.x - low.x + static_cast<std::int64_t>(i % kTile);
    const std::int64_t row = name.y - low.y + static_cast<std::int64_t>(i / kTile);
    if (column < 0 || row < 0 || column >= frame.width || row >= frame.height) continue;
    const auto k = static_cast<std::size_t>(row * frame.width + column);
    raster.cells[k] = tile.states[i];
    raster.hits[k] = tile.hits[i];
  }
}

OccupancyRaster BeamCounts::raster(const CellBox& box, std::uint32_t min_scans) const
{
  OccupancyRaster raster{frameOf(box), {}, {}};
  raster.cells.resize(std::size_t{raster.frame.width} * raster.frame.height);
  raster.hits.resize(raster.cells.size());
  for (std::int32_t y = firstOfTile(box.low.y); y < box.high.y; y += kTile)
  {
    for (std::int32_t x = firstOfTile(box.low.x); x < box.high.x; x += kTile)
    {
      if (tiles_.count(keyOf({x, y})) > 0) fillTile({x, y}, min_scans, box.low, raster);
    }
  }
  return raster;
}

void BeamCounts::forgetBelow(std::int32_t y)
{
  const auto is_gone = [&](std::uint64_t key) { return nameOf(key).y + kTile <= y; };
  for (auto tile = tiles_.begin(); tile != tiles_.end();)
    tile = is_gone(tile->first) ? tiles_.erase(tile) : std::next(tile);
  changed_.erase(std::remove_if(changed_.begin(), changed_.end(), is_gone), changed_.end());
#ifdef __GLIBC__
  malloc_trim(0);  // millions of small blocks would stay with the process, free as they are
#endif
}

std::vector<CellIndex> BeamCounts::takeChangedTiles()
{
  std::vector<CellIndex> names;
  names.reserve(changed_.size());
  for (const std::uint64_t key : changed_)
  {
    tiles_.at(key).changed = false;
    names.push_back(nameOf(key));
  }
  changed_.clear();
  std::sort(names.begin(), names.end(), comesFirst);
  return names;
}

std::vector<CellIndex> BeamCounts::tileNames() const
{
  std::vector<CellIndex> names;
  names.reserve(tiles_.size());
  for (const auto& [key, tile] : tiles_) names.push_back(nameOf(key));
  std::sort(names.begin(), names.end(), comesFirst);
  return names;
}

const BeamCounts::Tile& BeamCounts::tile(const CellIndex& name) const
{
  return tiles_.at(keyOf(name));
}

void BeamCounts::restore(const Extent& extent, const CellIndex& name, const Tile& tile)
{
  if (!isHeld(extent)) throw std::invalid_argument("BeamCounts: counts over too large an area");
  const CellBox box = boxOf(extent);
  const bool inside = name.x < box.high.x && name.y < box.high.y && name.x > box.low.x - kTile &&
                      name.y > box.low.y - kTile;
  if (!inside || name.x % kTile != 0 || name.y % kTile != 0)
  {
    throw std::invalid_argument("BeamCounts: no such tile");
  }
  for (std::size_t i = 0; i < kCellsOfTile; ++i)
  {
    if (isPossible(tile.count(i))) continue;
    throw std::invalid_argument("BeamCounts: a cell's counts contradict each other");
  }
  extent_ = extent;
  const std::uint64_t key = keyOf(name);
  Tile& restored = tiles_[key];
  const bool was_changed = restored.changed;
  restored = tile;
  restored.changed = was_changed;
  markChanged(key, restored);
}
}  // namespace sigloc
