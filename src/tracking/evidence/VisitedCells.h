// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <unordered_map>

#include "matching/dense/DenseVerifier.h"

namespace sigloc
{
/// What a track has looked at so far, as coarse cells of the map. A second addScan at the same
/// walls repeats the errors, and the likeness, of the first: only what is new to it is evidence.
class VisitedCells
{
 public:
  /// Returns the share of the cells that the returns end in, seen from `map_from_robot`, that were
  /// not seen within the last 10 m of travel, in [0, 1], and remembers them all. A view of few
  /// cells counts as part of a view, isolated returns as nothing. `travelled` [m] counts from any
  /// start and never falls.
  double add(const DenseScan& scan, const mrpt::math::TPose2D& map_from_robot, double travelled);

 private:
  std::unordered_map<std::uint64_t, double> last_seen_;  // cell: travelled [m]
};
}  // namespace sigloc
