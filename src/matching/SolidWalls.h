// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigloc/map/DenseField.h"
#include "sigloc/matching/DenseVerifier.h"

namespace sigloc
{
class CellView;
struct Placement;

/// Tells which beams pass through walls that no beam goes through. Keeps a reference to the field,
/// which must outlive it. Const and thread-safe.
class SolidWalls
{
 public:
  explicit SolidWalls(const DenseField& field);

  /// Returns the share of the first `beams` of a scan that pass a solid wall more than 0.4 m before
  /// their end when the robot stands at `pose`. \cite algorithm eq. (6.8)
  double throughShare(const DenseScan& scan, const mrpt::math::TPose2D& pose,
                      std::size_t beams) const;

 private:
  static constexpr std::size_t kRays = 64;  // at a time
  /// In cells of the frame, from its origin.
  struct Rays
  {
    std::size_t count;
    std::array<float, kRays> x, y;
    std::array<float, kRays> dx, dy;  // unit vectors
    std::array<float, kRays> length;
    std::array<float, kRays> per_column, per_row;  // length that leads on by one, signed
  };
  Rays raysOf(const DenseScan& scan, const Placement& place, std::size_t first,
              std::size_t count) const;
  std::size_t crossings(const Rays& rays) const;
  /// Outside of the frame nothing is near but what may be just inside.
  std::uint8_t ringsAt(std::int32_t column, std::int32_t row) const
  {
    // What lies before the frame becomes a very large number.
    const auto x = static_cast<std::uint32_t>(column);
    const auto y = static_cast<std::uint32_t>(row);
    if (x >= frame_.width || y >= frame_.height) return 1;
    return clear_rings_[static_cast<std::size_t>(y) * frame_.width + x];
  }
  float clearanceBesideWall(const CellView& cells, float x, float y) const;

  const DenseField& field_;
  RasterFrame frame_;
  float scale_;  // [cells/m] of the frame
  /// Rings of coarse cells around each one that hold no solid wall, 0: it holds one itself.
  std::vector<std::uint8_t> clear_rings_;
};
}  // namespace sigloc
