// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/BeamCounts.h"

namespace sigloc
{
BeamCounts::Count BeamCounts::Tile::count(std::size_t cell) const
{
  Count count;
  count.passes = passes_[cell];
  if (slots_[cell] == 0) return count;
  const Hits& hits = hits_[slots_[cell] - 1U];
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
  if (!hit && slots_[cell] == 0) return;
  hitsAt(cell) = {count.last_scan, count.sum_x, count.sum_y, count.hits, count.scans};
}

BeamCounts::Tile::Hits& BeamCounts::Tile::hitsAt(std::size_t cell)
{
  if (slots_[cell] == 0)
  {
    // Little more than needed: a map has tiles in great number.
    if (hits_.size() == hits_.capacity()) hits_.reserve(hits_.size() + 32);
    hits_.emplace_back();
    slots_[cell] = static_cast<std::uint16_t>(hits_.size());
  }
  return hits_[slots_[cell] - 1U];
}
}  // namespace sigloc
