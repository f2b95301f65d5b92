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
/// How much of what it has seen a hypothesis leaves unexplained, each cell of the ground counting
/// once however often it is looked at: a chair that has been moved speaks for the wrong one of two
/// places as long as it is in view, but it is one chair. Cells are those of the ground that
/// odometry tells: what one holds is the same thing for all hypotheses. \cite algorithm eq. (8.5)
class CellEvidence
{
 public:
  /// Takes a view in, of which the hypothesis explains each return by a share in [0, 1], after
  /// `travelled` [m] in all. Returns by how many cells what is left unexplained has grown; less
  /// than 0 where a better addScan explains more. What was seen longer than 10 m ago is news again.
  /// `travelled` counts from any start, also below 0, and never falls.
  double addScan(const ObservedCells& view, const std::vector<float>& explained, double travelled);

  /// How many cells all looks so far have left unexplained; what was news again counts again.
  double unexplained() const { return unexplained_; }

  /// How many cells all looks so far have shown; what was news again counts again. Eq. (8.29)
  double seen() const { return seen_; }

  /// Takes that back to 0; what has been seen stays seen.
  void countAnew() { seen_ = unexplained_ = 0; }

  /// The share of what was seen, in [0, 1]; 0 before anything was. \cite algorithm eq. (8.25)
  double unexplainedShare() const
  {
    return seen_ > 0 ? std::clamp(unexplained_ / seen_, 0.0, 1.0) : 0.0;
  }

 private:
  struct Cell
  {
    float explained = 0;  // sum over returns
    float returns = 0;
    double last_seen = 0;  // travelled [m]

    /// In [0, 1]; few returns tell little.
    double seen() const;
    double unexplained() const;
  };
  void forget(double travelled);

  std::unordered_map<std::uint64_t, Cell> cells_;
  double unexplained_ = 0;  // [cells], by all looks
  double seen_ = 0;
  double tidied_ = 0;  // travelled [m] when cells were last forgotten
};
}  // namespace sigloc
