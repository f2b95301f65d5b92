// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "matching/dense/DenseEvidence.h"
#include "tracking/evidence/ObservedCells.h"

namespace sigloc
{
/// How much of the observed cells a hypothesis leaves unexplained. A cell counts once, however
/// often it is scanned. A moved chair fits the wrong one of two poses in every scan, but it is one
/// chair. The cells are those of the odometry frame, so they are the same for all hypotheses.
/// \cite algorithm eq. (8.5), (8.26)
class CellEvidence
{
 public:
  /// Adds a scan, taken after `travelled` [m] in all. `explained` tells how the map explains each
  /// return at the hypothesis. Returns by how many cells the unexplained sum has grown,
  /// which is negative where the scan explains cells better than before. A cell that was last seen
  /// more than 10 m of travel ago counts anew. `travelled` counts from any start, also below 0, and
  /// never falls.
  double addScan(const ObservedCells& view, const std::vector<ExplainedReturn>& explained,
                 double travelled);

  /// How many cells all scans so far have left unexplained. A cell that counted anew counts again.
  double unexplained() const { return unexplained_; }

  /// How many cells of mapped area all scans so far have shown. A cell that counted anew counts
  /// again.
  double known() const { return known_; }

  /// Sets all sums back to 0, but keeps the cells.
  void countAnew() { unexplained_ = known_ = off_walls_ = 0; }

  /// Share of the cells of mapped area whose returns end off all walls or beyond one, in [0, 1]; 0
  /// before the first. Less than one cell counts as one. \cite algorithm eq. (8.22)
  double offWallShare() const;

 private:
  struct Cell
  {
    float explained = 0;  // sum of the explained shares of the returns
    float returns = 0;
    float in_unknown = 0;  // returns in unknown area
    float off_walls = 0;  // returns that end off all walls or beyond one
    double last_seen = 0;  // travelled [m]

    /// How far the cell counts, in [0, 1]; few returns count less.
    double seen() const;
    double unexplained() const;
    double unknown() const;
    double offWalls() const;
  };
  void forget(double travelled);

  std::unordered_map<std::uint64_t, Cell> cells_;
  double unexplained_ = 0;  // [cells], sum over all scans
  double known_ = 0;  // [cells] of mapped area, sum over all scans
  double off_walls_ = 0;  // [cells] off all walls or beyond one, sum over all scans
  double tidied_ = 0;  // travelled [m] when cells were last forgotten
};
}  // namespace sigloc
