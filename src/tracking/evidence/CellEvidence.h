// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

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
  /// Adds a scan, taken after `travelled` [m] in all. `explained` has the share in [0, 1] of each
  /// return that the hypothesis explains. Returns by how many cells the unexplained sum has grown,
  /// which is negative where the scan explains cells better than before. A cell that was last seen
  /// more than 10 m of travel ago counts anew. `travelled` counts from any start, also below 0, and
  /// never falls.
  double addScan(const ObservedCells& view, const std::vector<float>& explained, double travelled);

  /// How many cells all scans so far have left unexplained. A cell that counted anew counts again.
  double unexplained() const { return unexplained_; }

  /// How many cells all scans so far have shown. A cell that counted anew counts again. Eq. (8.29)
  double seen() const { return seen_; }

  /// Sets both sums back to 0, but keeps the cells.
  void countAnew() { seen_ = unexplained_ = 0; }

  /// Unexplained share of the cells seen, in [0, 1]; 0 before the first. \cite algorithm eq. (8.25)
  double unexplainedShare() const
  {
    return seen_ > 0 ? std::clamp(unexplained_ / seen_, 0.0, 1.0) : 0.0;
  }

 private:
  struct Cell
  {
    float explained = 0;  // sum of the explained shares of the returns
    float returns = 0;
    double last_seen = 0;  // travelled [m]

    /// How far the cell counts, in [0, 1]; few returns count less.
    double seen() const;
    double unexplained() const;
  };
  void forget(double travelled);

  std::unordered_map<std::uint64_t, Cell> cells_;
  double unexplained_ = 0;  // [cells], sum over all scans
  double seen_ = 0;  // [cells], sum over all scans
  double tidied_ = 0;  // travelled [m] when cells were last forgotten
};
}  // namespace sigloc
