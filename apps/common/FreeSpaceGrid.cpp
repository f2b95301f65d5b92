// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FreeSpaceGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <stdexcept>
#include <utility>

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kClearance = 0.25;  // [m] from the robot's centre to a wall
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kCellsPerStep = 2;  // of a drive

bool fits(const DenseField& field, const TPoint2D& place)
{
  const DenseCell* cell = cellAt(field, place);
  return cell != nullptr && cell->state() == CellState::free &&
         (cell->distance() == DenseCell::kFar ||
          cell->distance() * DenseField::kDistanceUnit >= kClearance);
}

/// Calls `visit(neighbour, distance in cells)` for the free neighbours of a cell.
template <class Visit>
void forNeighbours(const std::vector<std::uint8_t>& free, std::size_t columns, std::size_t cell,
                   const Visit& visit)
{
  const auto column = static_cast<std::int64_t>(cell % columns);
  for (const std::int64_t dy : {-1, 0, 1})
  {
    for (const std::int64_t dx : {-1, 0, 1})
    {
      if (dx == 0 && dy == 0) continue;
      const std::int64_t to =
          static_cast<std::int64_t>(cell) + dy * static_cast<std::int64_t>(columns) + dx;
      const bool inside = column + dx >= 0 && column + dx < static_cast<std::int64_t>(columns) &&
                          to >= 0 && to < static_cast<std::int64_t>(free.size());
      if (inside && free[static_cast<std::size_t>(to)] != 0)
        visit(static_cast<std::size_t>(to), std::hypot(dx, dy));
    }
  }
}

/// The cells that can be reached from one.
std::vector<std::size_t> component(const std::vector<std::uint8_t>& free, std::size_t columns,
                                   std::size_t seed, std::vector<std::uint8_t>& seen)
{
  std::vector<std::size_t> cells = {seed};
  seen[seed] = 1;
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    forNeighbours(free, columns, cells[k],
                  [&](std::size_t to, double)
                  {
                    if (seen[to] != 0) return;
                    seen[to] = 1;
                    cells.push_back(to);
                  });
  }
  return cells;
}
}  // namespace

FreeSpaceGrid::FreeSpaceGrid(const DenseField& field) : origin_(field.frame.origin)
{
  const auto count = [&](std::uint32_t cells)
  { return static_cast<std::size_t>(std::ceil(cells * field.frame.resolution / kCell)); };
  columns_ = count(field.frame.width);
  rows_ = count(field.frame.height);
  std::vector<std::uint8_t> fitting(columns_ * rows_);
  for (std::size_t k = 0; k < fitting.size(); ++k) fitting[k] = fits(field, centreOf(k)) ? 1 : 0;
  std::vector<std::uint8_t> seen(fitting.size());
  for (std::size_t k = 0; k < fitting.size(); ++k)
  {
    if (fitting[k] == 0 || seen[k] != 0) continue;
    std::vector<std::size_t> cells = component(fitting, columns_, k, seen);
    if (cells.size() > cells_.size()) cells_ = std::move(cells);
  }
  if (cells_.empty()) throw std::invalid_argument("no free space that a robot fits into");
  std::sort(cells_.begin(), cells_.end());
  free_.resize(fitting.size());
  for (const std::size_t cell : cells_) free_[cell] = 1;
}

TPoint2D FreeSpaceGrid::centreOf(std::size_t cell) const
{
  const std::size_t row = cell / columns_;
  const std::size_t column = cell % columns_;
  return {origin_.x + (static_cast<double>(column) + 0.5) * kCell,
          origin_.y + (static_cast<double>(row) + 0.5) * kCell};
}

std::size_t FreeSpaceGrid::nearestCell(const TPoint2D& place) const
{
  return *std::min_element(
      cells_.begin(), cells_.end(),
      [&](std::size_t a, std::size_t b)
      { return (centreOf(a) - place).sqrNorm() < (centreOf(b) - place).sqrNorm(); });
}

std::vector<TPoint2D> FreeSpaceGrid::spreadPlaces(std::size_t count) const
{
  // Free space is ragged: of squares of this side, more hold some of it than are wanted.
  constexpr double kWider = 1.05;
  double side = std::max(kCell, std::sqrt(area() / static_cast<double>(count)));
  std::vector<TPoint2D> places = placesInSquares(side);
  while (places.size() > count)
  {
    std::vector<TPoint2D> fewer = placesInSquares(side *= kWider);
    if (fewer.size() < count) break;
    places = std::move(fewer);
  }
  const std::size_t wanted = std::min(count, places.size());
  std::vector<TPoint2D> chosen;
  chosen.reserve(wanted);
  for (std::size_t k = 0; k < wanted; ++k) chosen.push_back(places[k * places.size() / wanted]);
  return chosen;
}

std::vector<TPoint2D> FreeSpaceGrid::placesInSquares(double side) const
{
  // Of each square the free cell nearest to its middle.
  std::map<std::pair<std::int64_t, std::int64_t>, std::pair<double, std::size_t>> squares;
  for (const std::size_t cell : cells_)
  {
    const TPoint2D place = (centreOf(cell) - origin_) / side;
    const std::pair key(static_cast<std::int64_t>(place.y), static_cast<std::int64_t>(place.x));
    const double off = std::hypot(place.x - static_cast<double>(key.second) - 0.5,
                                  place.y - static_cast<double>(key.first) - 0.5);
    const auto [square, is_new] = squares.emplace(key, std::pair(off, cell));
    if (!is_new) square->second = std::min(square->second, std::pair(off, cell));
  }
  std::vector<TPoint2D> places;
  places.reserve(squares.size());
  for (const auto& [key, nearest] : squares) places.push_back(centreOf(nearest.second));
  return places;
}

std::vector<TPose2D> FreeSpaceGrid::drive(const TPoint2D& from, double length,
                                          std::uint64_t choice) const
{
  const double wanted = length / kCell;
  std::vector<double> distance(free_.size(), kInfinity);
  std::vector<std::size_t> parent(free_.size());
  using Open = std::pair<double, std::size_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const std::size_t start = nearestCell(from);
  distance[start] = 0;
  open.emplace(0, start);
  std::vector<std::size_t> ends = {start};  // at the wanted distance, else the farthest
  bool reached = false;
  while (!open.empty())
  {
    const auto [to_here, cell] = open.top();
    open.pop();
    if (to_here > distance[cell]) continue;
    if (to_here >= wanted)
    {
      if (!reached) ends.clear();
      reached = true;
      ends.push_back(cell);
      continue;  // no need to go farther
    }
    if (!reached) ends = {cell};
    forNeighbours(free_, columns_, cell,
                  [&, here = cell, so_far = to_here](std::size_t to, double step)
                  {
                    if (so_far + step >= distance[to]) return;
                    distance[to] = so_far + step;
                    parent[to] = here;
                    open.emplace(distance[to], to);
                  });
  }
  std::vector<std::size_t> way = {ends[choice % ends.size()]};
  while (way.back() != start) way.push_back(parent[way.back()]);
  std::reverse(way.begin(), way.end());
  std::vector<TPose2D> poses;
  for (std::size_t k = 0; k < way.size(); k += kCellsPerStep)
  {
    const TPoint2D here = centreOf(way[k]);
    const TPoint2D ahead = centreOf(way[std::min(k + kCellsPerStep, way.size() - 1)]) - here;
    const double heading = ahead.sqrNorm() > 0 ? std::atan2(ahead.y, ahead.x)
                           : poses.empty()     ? 0
                                               : poses.back().phi;
    poses.emplace_back(here.x, here.y, heading);
  }
  return poses;
}
}  // namespace sigloc
