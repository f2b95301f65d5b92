// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "map/ClearBlocks.h"
#include "matching/dense/DenseEvidence.h"
#include "matching/dense/DenseScan.h"
#include "sigloc/map/DenseField.h"

namespace sigloc
{
struct Placement;

/// The ray crossing test: finds the beams that pass through solid walls. Const and thread-safe.
/// \cite algorithm eq. (6.2), (6.8)
class WallCrossings
{
 public:
  static constexpr std::size_t kRays = 64;  ///< beams that are tested at a time

  explicit WallCrossings(const DenseField& field);

  /// Tests the first `beams` <= kRays of a scan with the robot at `pose`. Returns which of them
  /// pass a solid wall more than 0.4 m before their end: bit i is set for the i-th. \cite algorithm
  /// eq. (6.8)
  std::uint64_t throughBits(const DenseScan& scan, const mrpt::math::TPose2D& pose,
                            std::size_t beams) const;

 private:
  std::uint64_t crossings(const DenseScan& scan, const Placement& place, std::size_t count) const;

  RasterFrame frame_;
  ClearBlocks clear_blocks_;
};
}  // namespace sigloc
