// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigloc/map/DenseField.h"
#include "sigloc/matching/DenseVerifier.h"

namespace sigloc
{
class CellView;

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
  struct Ray
  {
    float x, y;  // [m] in the map
    float dx, dy;  // unit vector
    float length;  // [m]
    float along;  // [m] it has come
  };
  std::size_t crossings(std::vector<Ray>& rays) const;
  float clearanceAt(const CellView& cells, float x, float y) const;

  const DenseField& field_;
  RasterFrame frame_;
  float scale_;  // [1/m] cells of the frame
  /// Rings of coarse cells around each one that hold no solid wall, 0: it holds one itself.
  std::vector<std::uint8_t> clear_rings_;
};
}  // namespace sigloc
