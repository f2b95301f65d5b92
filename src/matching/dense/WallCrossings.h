// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "matching/dense/DenseEvidence.h"
#include "matching/dense/DenseScan.h"
#include "sigloc/map/DenseField.h"

namespace sigloc
{
struct Placement;

/// Tells which beams pass through walls that no beam goes through. Const and thread-safe.
class WallCrossings
{
 public:
  static constexpr std::size_t kRays = 64;  ///< beams that are followed at a time

  explicit WallCrossings(const DenseField& field);

  /// Returns the share of the first `beams` of a scan that pass a solid wall more than 0.4 m before
  /// their end when the robot stands at `pose`. \cite algorithm eq. (6.8)
  double throughShare(const DenseScan& scan, const mrpt::math::TPose2D& pose,
                      std::size_t beams) const;

  /// Tells of the first `beams` <= kRays which ones do: bit i is set for the i-th.
  std::uint64_t throughBits(const DenseScan& scan, const mrpt::math::TPose2D& pose,
                            std::size_t beams) const;

 private:
  std::uint64_t crossings(const DenseScan& scan, const Placement& place, std::size_t first,
                          std::size_t count) const;

  RasterFrame frame_;
  /// Rings of cells around each one that hold no solid wall, 0: it holds one itself. One more at
  /// the end stands for all that lies outside of the frame.
  std::vector<std::uint8_t> clear_rings_;
};
}  // namespace sigloc
