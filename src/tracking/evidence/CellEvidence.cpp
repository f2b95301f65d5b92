// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/evidence/CellEvidence.h"

#include <algorithm>
#include <iterator>

namespace sigloc
{
namespace
{
constexpr float kFullReturns = 3;  // returns from which on a cell counts in full, eq. (8.26)
}  // namespace

double CellEvidence::Cell::seen() const
{
  return static_cast<double>(std::min(1.0F, returns / kFullReturns));
}

double CellEvidence::Cell::unexplained() const
{
  return returns > 0 ? seen() * (1.0 - static_cast<double>(explained / returns)) : 0.0;
}

double CellEvidence::Cell::unknown() const
{
  return returns > 0 ? seen() * static_cast<double>(in_unknown / returns) : 0.0;
}

double CellEvidence::Cell::offWalls() const
{
  return returns > 0 ? seen() * static_cast<double>(off_walls / returns) : 0.0;
}

double CellEvidence::offWallShare() const
{
  return std::clamp(off_walls_ / std::max(1.0, known_), 0.0, 1.0);
}

double CellEvidence::addScan(const ObservedCells& view,
                             const std::vector<ExplainedReturn>& explained, double travelled)
{
  forget(travelled);
  std::vector<Cell> observed(view.cells.size());
  for (std::size_t i = 0; i < explained.size(); ++i)
  {
    if (view.cell_of[i] == ObservedCells::kNowhere) continue;
    Cell& cell = observed[view.cell_of[i]];
    cell.explained += explained[i].share;
    cell.returns += 1;
    cell.in_unknown += explained[i].unknown ? 1.0F : 0.0F;
    cell.off_walls += explained[i].off_walls ? 1.0F : 0.0F;
  }
  const double unexplained_before = unexplained_;
  for (std::size_t k = 0; k < observed.size(); ++k)
  {
    Cell& cell = cells_[view.cells[k]];
    if (travelled - cell.last_seen > kMemory) cell = {};
    const Cell before = cell;
    cell.explained += observed[k].explained;
    cell.returns += observed[k].returns;
    cell.in_unknown += observed[k].in_unknown;
    cell.off_walls += observed[k].off_walls;
    cell.last_seen = travelled;
    unexplained_ += cell.unexplained() - before.unexplained();
    known_ += cell.seen() - before.seen() - (cell.unknown() - before.unknown());
    off_walls_ += cell.offWalls() - before.offWalls();
  }
  return unexplained_ - unexplained_before;
}

/// Frees the memory of old cells now and then. addScan() resets an old cell that is seen again, so
/// the time of this call changes no result.
void CellEvidence::forget(double travelled)
{
  if (travelled - tidied_ <= kMemory) return;
  tidied_ = travelled;
  for (auto cell = cells_.begin(); cell != cells_.end();)
  {
    cell = travelled - cell->second.last_seen > kMemory ? cells_.erase(cell) : std::next(cell);
  }
}
}  // namespace sigloc
