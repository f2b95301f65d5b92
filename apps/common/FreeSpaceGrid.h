// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <vector>

#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Where a round robot can go in a map: the largest connected part of its free space that keeps a
/// clearance from every wall, as coarse cells.
class FreeSpaceGrid
{
 public:
  /// Throws std::invalid_argument where the robot fits nowhere.
  explicit FreeSpaceGrid(const DenseField& field);

  /// [m^2]
  double area() const { return kCell * kCell * static_cast<double>(cells_.size()); }

  /// Returns `count` places, at most one in each square of a regular division, row by row. Fewer
  /// where so many cells are not free.
  std::vector<mrpt::math::TPoint2D> spreadPlaces(std::size_t count) const;

  /// Returns the poses of a drive from a place of the free space, a step about half a metre. It
  /// goes a shortest way of `length` [m], or to the farthest cell. `choice` picks one of the ends
  /// that there are.
  std::vector<mrpt::math::TPose2D> drive(const mrpt::math::TPoint2D& from, double length,
                                         std::uint64_t choice) const;

 private:
  static constexpr double kCell = 0.25;  // [m]
  std::vector<mrpt::math::TPoint2D> placesInSquares(double side) const;
  std::size_t nearestCell(const mrpt::math::TPoint2D& place) const;
  mrpt::math::TPoint2D centreOf(std::size_t cell) const;

  mrpt::math::TPoint2D origin_;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<std::uint8_t> free_;
  std::vector<std::size_t> cells_;  // the free ones, row by row
};
}  // namespace sigloc
