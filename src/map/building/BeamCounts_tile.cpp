// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/BeamCounts.h"

namespace sigloc
{
BeamCounts::Count BeamCounts::Tile::count(std::size_t cell) const
{
  Count count;
  count.passes = passes_[cell];
  if (!isHit(cell)) return count;
  const Hits& hits = hits_[indexOf(cell)];
  count.last_scan = hits.last_scan;
  count.hits = hits.hits;
  count.scans = hits.scans;
  count.sum_x = hits.sum_x;
  count.sum_y = hits.sum_y;
  return count;
}

void BeamCounts::Tile::set(std::size_t cell, const Count& count)
{
  passes_[cell] = count.passes;
  const bool hit = count.hits != 0 || count.scans != 0 || count.sum_x != 0 || count.sum_y != 0;
  if (!hit && !isHit(cell)) return;
  hitsAt(cell) = {count.last_scan, count.sum_x, count.sum_y, count.hits, count.scans};
}

BeamCounts::Tile::Hits& BeamCounts::Tile::hitsAt(std::size_t cell)
{
  const std::size_t index = indexOf(cell);
  if (!isHit(cell))
  {
    // Little more than needed: a map has tiles in great number.
    if (hits_.size() == hits_.capacity()) hits_.reserve(hits_.size() + 32);
    hits_.insert(hits_.begin() + static_cast<std::ptrdiff_t>(index), Hits{});
    hit_[cell / 64] |= std::uint64_t{1} << cell % 64;
    for (std::size_t k = cell / 64 + 1; k < hits_before_.size(); ++k) ++hits_before_[k];
  }
  return hits_[index];
}
}  // namespace sigloc
