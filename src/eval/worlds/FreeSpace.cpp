// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/FreeSpace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <stdexcept>
#include <utility>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr double kMaxCells = 4e6;
}  // namespace

double distanceTo(const WallSegment& segment, const TPoint2D& p)
{
  const TPoint2D along = segment.end - segment.start;
  const TPoint2D to_p = p - segment.start;
  const double squared = along.x * along.x + along.y * along.y;
  const double share =
      squared > 0 ? std::clamp((to_p.x * along.x + to_p.y * along.y) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(to_p.x - share * along.x, to_p.y - share * along.y);
}

FreeSpace::FreeSpace(const World& world, double clearance, double cell_size)
    : bounds_(world.bounds), cell_size_(cell_size)
{
  const double width = bounds_.x_max - bounds_.x_min;
  const double height = bounds_.y_max - bounds_.y_min;
  if (!(clearance >= 0) || !(cell_size > 0) || !(width > 0) || !(height > 0))
  {
    throw std::invalid_argument("free space needs bounds, a clearance >= 0 and a cell size > 0");
  }
  cell_size_ = std::max(cell_size_, std::sqrt(width * height / kMaxCells));
  columns_ = static_cast<std::int64_t>(std::ceil(width / cell_size_));
  rows_ = static_cast<std::int64_t>(std::ceil(height / cell_size_));
  free_.assign(static_cast<std::size_t>(columns_ * rows_), 1);
  for (const WallSegment& segment : visibleSegments(world)) blockNearSegment(segment, clearance);
  for (const Disc& disc : world.discs) blockNearDisc(disc, clearance);
  keepComponent(world.inside);
}

void FreeSpace::blockNearSegment(const WallSegment& segment, double clearance)
{
  // A surface always blocks the cells it runs through, or a robot of no size would pass.
  const double reach = std::max(clearance, 0.71 * cell_size_);
  const auto clamped_column = [&](double x)
  {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>((x - bounds_.x_min) / cell_size_), 0,
                                    columns_ - 1);
  };
  const auto clamped_row = [&](double y)
  {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>((y - bounds_.y_min) / cell_size_), 0,
                                    rows_ - 1);
  };
  const auto [x_low, x_high] = std::minmax(segment.start.x, segment.end.x);
  const auto [y_low, y_high] = std::minmax(segment.start.y, segment.end.y);
  for (auto r = clamped_row(y_low - reach); r <= clamped_row(y_high + reach); ++r)
  {
    for (auto c = clamped_column(x_low - reach); c <= clamped_column(x_high + reach); ++c)
    {
      const auto cell = static_cast<std::size_t>(r * columns_ + c);
      if (free_[cell] != 0 && distanceTo(segment, centreOf(cell)) < reach) free_[cell] = 0;
    }
  }
}

void FreeSpace::blockNearDisc(const Disc& disc, double clearance)
{
  // A disc is a segment without length seen from farther away.
  blockNearSegment({disc.centre, disc.centre}, disc.radius + clearance);
}

/// Keeps the cells connected with a place, or else the largest set of connected cells.
void FreeSpace::keepComponent(const std::optional<TPoint2D>& inside)
{
  const std::size_t first = inside ? cellAt(*inside) : 0;
  const std::size_t last = inside ? std::min(first + 1, free_.size()) : free_.size();
  std::vector<std::uint32_t> label(free_.size(), 0);
  std::vector<std::uint32_t> stack;
  std::uint32_t labels = 0;
  std::uint32_t best_label = 0;
  std::size_t best_size = 0;
  for (std::size_t seed = first; seed < last; ++seed)
  {
    if (free_[seed] == 0 || label[seed] != 0) continue;
    label[seed] = ++labels;
    std::size_t size = 0;
    stack.push_back(static_cast<std::uint32_t>(seed));
    while (!stack.empty())
    {
      const std::int64_t cell = stack.back();
      stack.pop_back();
      ++size;
      const std::int64_t c = cell % columns_;
      const std::int64_t r = cell / columns_;
      const std::array<std::pair<std::int64_t, std::int64_t>, 4> neighbours = {
          std::pair{c - 1, r}, {c + 1, r}, {c, r - 1}, {c, r + 1}};
      for (const auto& [nc, nr] : neighbours)
      {
        const auto neighbour = static_cast<std::size_t>(nr * columns_ + nc);
        if (!isFree(nc, nr) || label[neighbour] != 0) continue;
        label[neighbour] = labels;
        stack.push_back(static_cast<std::uint32_t>(neighbour));
      }
    }
    if (size > best_size)
    {
      best_size = size;
      best_label = labels;
    }
  }
  if (best_size == 0) throw std::invalid_argument("the world has no room for the robot");
  free_cells_.reserve(best_size);
  for (std::size_t cell = 0; cell < free_.size(); ++cell)
  {
    free_[cell] = label[cell] == best_label ? 1 : 0;
    if (free_[cell] != 0) free_cells_.push_back(static_cast<std::uint32_t>(cell));
  }
}

std::size_t FreeSpace::cellAt(const TPoint2D& p) const
{
  const auto c = static_cast<std::int64_t>(std::floor((p.x - bounds_.x_min) / cell_size_));
  const auto r = static_cast<std::int64_t>(std::floor((p.y - bounds_.y_min) / cell_size_));
  if (!isFree(c, r)) return free_.size();
  return static_cast<std::size_t>(r * columns_ + c);
}

TPoint2D FreeSpace::centreOf(std::size_t cell) const
{
  const auto columns = static_cast<std::size_t>(columns_);
  const std::size_t column = cell % columns;
  const std::size_t row = cell / columns;
  return {bounds_.x_min + (static_cast<double>(column) + 0.5) * cell_size_,
          bounds_.y_min + (static_cast<double>(row) + 0.5) * cell_size_};
}

bool FreeSpace::contains(const TPoint2D& p) const
{
  return cellAt(p) < free_.size();
}

TPoint2D FreeSpace::randomPlace(Random& random) const
{
  const TPoint2D centre = centreOf(free_cells_[random.index(free_cells_.size())]);
  const double x = centre.x + cell_size_ * random.uniform(-0.49, 0.49);
  return {x, centre.y + cell_size_ * random.uniform(-0.49, 0.49)};
}

bool FreeSpace::lineIsFree(const TPoint2D& from, const TPoint2D& to) const
{
  const TPoint2D along = to - from;
  const double length = std::hypot(along.x, along.y);
  const auto steps = static_cast<std::size_t>(length / (0.25 * cell_size_)) + 1;
  for (std::size_t i = 0; i <= steps; ++i)
  {
    if (!contains(from + along * (static_cast<double>(i) / static_cast<double>(steps))))
    {
      return false;
    }
  }
  return true;
}

std::vector<std::size_t> FreeSpace::cellPath(std::size_t from, std::size_t to) const
{
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  const auto column = [&](std::size_t cell) { return static_cast<std::int64_t>(cell) % columns_; };
  const auto row = [&](std::size_t cell) { return static_cast<std::int64_t>(cell) / columns_; };
  const auto remaining = [&](std::size_t cell)
  {
    const double dx = std::abs(static_cast<double>(column(cell) - column(to)));
    const double dy = std::abs(static_cast<double>(row(cell) - row(to)));
    return std::max(dx, dy) + (M_SQRT2 - 1) * std::min(dx, dy);
  };
  std::vector<float> cost(free_.size(), std::numeric_limits<float>::infinity());
  std::vector<std::uint32_t> came_from(free_.size(), kNone);
  // Ties are broken by the cell's number, so that the path is always the same.
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost[from] = 0;
  open.emplace(remaining(from), static_cast<std::uint32_t>(from));
  while (!open.empty())
  {
    const auto [estimate, cell] = open.top();
    open.pop();
    if (cell == to) break;
    if (estimate > static_cast<double>(cost[cell]) + remaining(cell) + 1e-4) continue;  // outdated
    for (int dr = -1; dr <= 1; ++dr)
    {
      for (int dc = -1; dc <= 1; ++dc)
      {
        const std::int64_t c = column(cell) + dc;
        const std::int64_t r = row(cell) + dr;
        // A diagonal step must not cut a blocked corner.
        if ((dc == 0 && dr == 0) || !isFree(c, r) || !isFree(column(cell), r) ||
            !isFree(c, row(cell)))
        {
          continue;
        }
        const auto next = static_cast<std::size_t>(r * columns_ + c);
        const float step = dc != 0 && dr != 0 ? static_cast<float>(M_SQRT2) : 1.0F;
        if (cost[cell] + step >= cost[next]) continue;
        cost[next] = cost[cell] + step;
        came_from[next] = cell;
        open.emplace(static_cast<double>(cost[next]) + remaining(next),
                     static_cast<std::uint32_t>(next));
      }
    }
  }
  std::vector<std::size_t> cells = {to};
  while (cells.back() != from) cells.push_back(came_from[cells.back()]);
  std::reverse(cells.begin(), cells.end());
  return cells;
}

std::vector<TPoint2D> FreeSpace::path(const TPoint2D& from, const TPoint2D& to) const
{
  const std::size_t from_cell = cellAt(from);
  const std::size_t to_cell = cellAt(to);
  if (from_cell == free_.size() || to_cell == free_.size())
  {
    throw std::invalid_argument("a path must start and end in free space");
  }
  std::vector<TPoint2D> points = {from};
  for (const std::size_t cell : cellPath(from_cell, to_cell)) points.push_back(centreOf(cell));
  points.push_back(to);

  // Greedy short cuts: from each corner straight to the farthest place in sight, searched by
  // doubling so that long paths stay cheap.
  std::vector<TPoint2D> corners = {from};
  std::size_t at = 0;
  while (at + 1 < points.size())
  {
    std::size_t reach = at + 1;
    for (std::size_t jump = 2; at + jump < points.size() + jump / 2; jump *= 2)
    {
      const std::size_t target = std::min(at + jump, points.size() - 1);
      if (!lineIsFree(points[at], points[target])) break;
      reach = target;
    }
    while (reach + 1 < points.size() && lineIsFree(points[at], points[reach + 1])) ++reach;
    corners.push_back(points[reach]);
    at = reach;
  }
  return corners;
}

std::vector<TPoint2D> FreeSpace::coverage(double spacing) const
{
  if (!(spacing > 0)) throw std::invalid_argument("the spacing of a coverage must be > 0");
  const auto squares = [&](double extent)
  { return static_cast<std::size_t>(std::ceil(extent / spacing)); };
  const std::size_t square_columns =
      std::max<std::size_t>(1, squares(bounds_.x_max - bounds_.x_min));
  const std::size_t square_rows = std::max<std::size_t>(1, squares(bounds_.y_max - bounds_.y_min));
  std::vector<std::size_t> nearest(square_columns * square_rows, free_.size());
  std::vector<double> distance(nearest.size(), std::numeric_limits<double>::infinity());
  for (const std::uint32_t cell : free_cells_)
  {
    const TPoint2D p = centreOf(cell);
    const auto c =
        std::min(static_cast<std::size_t>((p.x - bounds_.x_min) / spacing), square_columns - 1);
    const auto r =
        std::min(static_cast<std::size_t>((p.y - bounds_.y_min) / spacing), square_rows - 1);
    const double d = std::hypot(p.x - bounds_.x_min - (static_cast<double>(c) + 0.5) * spacing,
                                p.y - bounds_.y_min - (static_cast<double>(r) + 0.5) * spacing);
    const std::size_t square = r * square_columns + c;
    if (d >= distance[square]) continue;
    distance[square] = d;
    nearest[square] = cell;
  }
  std::vector<TPoint2D> places;
  for (std::size_t r = 0; r < square_rows; ++r)
  {
    for (std::size_t k = 0; k < square_columns; ++k)
    {
      const std::size_t c = r % 2 == 0 ? k : square_columns - 1 - k;
      const std::size_t cell = nearest[r * square_columns + c];
      if (cell < free_.size()) places.push_back(centreOf(cell));
    }
  }
  return places;
}
}  // namespace sigloc
