// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "eval/worlds/Random.h"
#include "eval/worlds/World.h"

namespace sigloc
{
/// Returns the distance of a point to a surface [m].
double distanceTo(const WallSegment& segment, const mrpt::math::TPoint2D& p);

/// Distance [m] that the robot of most experiments keeps from every surface.
constexpr double kRobotClearance = 0.35;

/// Where a round robot can go in a world: connected cells whose centres keep a clearance from every
/// surface. They are those around World::inside, or the largest such set. Plans paths in it.
class FreeSpace
{
 public:
  /// `clearance` [m] is the robot's radius and a margin; `cell_size` [m] grows for worlds of more
  /// than four million cells. Throws std::invalid_argument for a world without free space.
  FreeSpace(const World& world, double clearance, double cell_size = 0.1);

  /// True when the robot can be there.
  bool contains(const mrpt::math::TPoint2D& p) const;

  /// Returns a position that is uniform over the free cells.
  mrpt::math::TPoint2D randomPlace(Random& random) const;

  /// Returns a shortest path of straight pieces between two positions of the free space (A* over
  /// the cells, then short cuts), from `from` to `to` inclusive. Throws std::invalid_argument when
  /// an end is not free.
  std::vector<mrpt::math::TPoint2D> path(const mrpt::math::TPoint2D& from,
                                         const mrpt::math::TPoint2D& to) const;

  /// Returns one free position for each square of `spacing` [m] that holds any, in rows that run to
  /// and fro. From these positions the whole space is seen.
  std::vector<mrpt::math::TPoint2D> coverage(double spacing) const;

  double cellSize() const { return cell_size_; }
  std::int64_t columns() const { return columns_; }
  std::int64_t rows() const { return rows_; }
  bool isFree(std::int64_t column, std::int64_t row) const
  {
    return column >= 0 && column < columns_ && row >= 0 && row < rows_ &&
           free_[static_cast<std::size_t>(row * columns_ + column)] != 0;
  }

 private:
  void blockNearSegment(const WallSegment& segment, double clearance);
  void blockNearDisc(const Disc& disc, double clearance);
  void keepComponent(const std::optional<mrpt::math::TPoint2D>& inside);
  std::size_t cellAt(const mrpt::math::TPoint2D& p) const;
  mrpt::math::TPoint2D centreOf(std::size_t cell) const;
  bool lineIsFree(const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& to) const;
  std::vector<std::size_t> cellPath(std::size_t from, std::size_t to) const;

  Bounds bounds_;
  double cell_size_;
  std::int64_t columns_ = 0;
  std::int64_t rows_ = 0;
  std::vector<std::uint8_t> free_;
  std::vector<std::uint32_t> free_cells_;
};
}  // namespace sigloc
