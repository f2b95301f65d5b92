// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/counted_field.h"

#include <algorithm>

namespace sigloc
{
namespace
{
constexpr std::int32_t kLeastRows = 128;  // of a strip, or its margins would cost too much

/// Copies rows from the solved window into the field, and counts their cells.
void takeRows(const DenseField& window, std::size_t first, std::size_t to, std::size_t rows,
              DenseField& field, std::size_t& free_cells)
{
  const std::size_t width = field.frame.width;
  const auto from = window.cells.begin() + static_cast<std::ptrdiff_t>(first * width);
  const auto end = from + static_cast<std::ptrdiff_t>(rows * width);
  for (auto cell = from; cell != end; ++cell)
  {
    free_cells += cell->state == CellState::free ? 1U : 0U;
    field.wall_cells += isWall(cell->state) ? 1U : 0U;
  }
  std::copy(from, end, field.cells.begin() + static_cast<std::ptrdiff_t>(to * width));
}
}  // namespace

DenseField denseFieldOf(const BeamCounts& counts, std::uint32_t min_scans, std::int32_t strip_cells)
{
  const CellBox box = counts.box();
  const std::int32_t reach = fieldReach(counts.resolution());
  const std::int32_t rows = std::max(kLeastRows, strip_cells / box.width());
  DenseField field;
  field.frame = counts.frameOf(box);
  field.cells.resize(std::size_t{field.frame.width} * field.frame.height);
  std::size_t free_cells = 0;
  for (std::int32_t low = box.low.y; low < box.high.y; low += rows)
  {
    const std::int32_t high = std::min(low + rows, box.high.y);
    const CellBox window{{box.low.x, std::max(low - reach, box.low.y)},
                         {box.high.x, std::min(high + reach, box.high.y)}};
    const auto below = static_cast<std::size_t>(low - window.low.y);
    takeRows(buildDenseField(counts.raster(window, min_scans)), below,
             static_cast<std::size_t>(low - box.low.y), static_cast<std::size_t>(high - low), field,
             free_cells);
  }
  field.free_area = static_cast<double>(free_cells) * counts.resolution() * counts.resolution();
  return field;
}
}  // namespace sigloc
