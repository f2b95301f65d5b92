// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/lattice/best_lattice_poses.h"

#include <algorithm>
#include <array>
#include <deque>

#include "eval/methods/lattice/lattice_search.h"

namespace sigloc
{

namespace
{
constexpr std::uint32_t kTopLevel = 6;  // blocks of 64 x 64 positions: 12.8 m

// Maximum over `window` values from each position on, one line of a grid, in place of the line;
// a monotonic queue makes it linear whatever the window.
void slideMaximum(std::uint8_t* line, std::int32_t count, std::ptrdiff_t step, std::int32_t window,
                  std::vector<std::uint8_t>& scratch)
{
  scratch.resize(static_cast<std::size_t>(count));
  for (std::int32_t i = 0; i < count; ++i) scratch[static_cast<std::size_t>(i)] = line[i * step];
  std::deque<std::int32_t> queue;  // positions, values decreasing
  for (std::int32_t i = count - 1; i >= 0; --i)
  {
    const std::uint8_t value = scratch[static_cast<std::size_t>(i)];
    while (!queue.empty() && scratch[static_cast<std::size_t>(queue.back())] <= value)
    {
      queue.pop_back();
    }
    queue.push_back(i);
    if (queue.front() >= i + window) queue.pop_front();
    line[i * step] = scratch[static_cast<std::size_t>(queue.front())];
  }
}

// The widest span, in cells, of 2^level neighbouring positions.
std::int32_t spanOf(const std::vector<std::int32_t>& cells, std::uint32_t level)
{
  const std::size_t block = std::size_t{1} << level;
  std::int32_t widest = 1;
  for (std::size_t i = 0; i < cells.size(); i += block)
  {
    const std::size_t last = std::min(i + block, cells.size()) - 1;
    widest = std::max(widest, cells[last] - cells[i] + 1);
  }
  return widest;
}
}  // namespace

BranchAndBoundSearch::BranchAndBoundSearch(const DenseSearchSpace& space) : space_(space)
{
  const LikelihoodGrid& grid = space.coarse();
  const auto columns = static_cast<std::uint32_t>(space.columnCells().size());
  const auto rows = static_cast<std::uint32_t>(space.rowCells().size());
  std::vector<std::uint8_t> scratch;
  for (std::uint32_t h = 0; h <= kTopLevel; ++h)
  {
    const std::uint32_t block = 1U << h;
    Level level;
    level.block_columns = (columns + block - 1) / block;
    level.block_rows = (rows + block - 1) / block;
    level.maxima = grid.values();
    const std::int32_t window_x = spanOf(space.columnCells(), h);
    const std::int32_t window_y = spanOf(space.rowCells(), h);
    for (std::int32_t r = 0; r < grid.rows(); ++r)
    {
      slideMaximum(
          &level.maxima[static_cast<std::size_t>(r) * static_cast<std::size_t>(grid.stride())],
          grid.stride(), 1, window_x, scratch);
    }
    for (std::int32_t c = 0; c < grid.stride(); ++c)
    {
      slideMaximum(&level.maxima[static_cast<std::size_t>(c)], grid.rows(), grid.stride(), window_y,
                   scratch);
    }
    level.any_free.assign(std::size_t{level.block_columns} * level.block_rows, 0);
    for (std::uint32_t row = 0; row < rows; ++row)
    {
      for (std::uint32_t column = 0; column < columns; ++column)
      {
        if (!space.freePlaces()[std::size_t{row} * columns + column]) continue;
        level.any_free[std::size_t{row / block} * level.block_columns + column / block] = 1;
      }
    }
    levels_.push_back(std::move(level));
  }
}

/// One search: the headings' offsets, the best so far and the number of look-ups.
struct BranchAndBoundSearch::Run
{
  struct Block
  {
    std::uint32_t bound;
    std::uint32_t heading;  // position in space.headings()
    std::uint32_t row;  // in blocks of its level
    std::uint32_t column;
  };

  const BranchAndBoundSearch& search;
  detail::BestLatticePoses best;
  std::vector<std::vector<std::ptrdiff_t>> steps;  // a heading
  std::uint64_t scored = 0;

  std::uint32_t boundOf(std::uint32_t h, std::uint32_t heading, std::uint32_t row,
                        std::uint32_t column)
  {
    const DenseSearchSpace& space = search.space_;
    const std::uint8_t* cell =
        search.levels_[h].maxima.data() +
        space.coarse().indexOf(space.columnCells()[column << h], space.rowCells()[row << h]);
    std::uint32_t sum = 0;
    for (const std::ptrdiff_t step : steps[heading]) sum += cell[step];
    ++scored;
    return sum;
  }

  void descend(std::uint32_t h, const Block& block)
  {
    if (block.bound < best.threshold()) return;
    if (h == 0)
    {
      best.offer({block.bound, search.space_.headings()[block.heading], block.row, block.column});
      return;
    }
    const Level& below = search.levels_[h - 1];
    std::array<Block, 4> children{};
    std::size_t count = 0;
    for (std::uint32_t quarter = 0; quarter < 4; ++quarter)
    {
      const std::uint32_t row = 2 * block.row + quarter / 2;
      const std::uint32_t column = 2 * block.column + quarter % 2;
      if (row >= below.block_rows || column >= below.block_columns) continue;
      if (!below.any_free[std::size_t{row} * below.block_columns + column]) continue;
      // Best bound first: at most four, so inserted in place.
      const Block child{boundOf(h - 1, block.heading, row, column), block.heading, row, column};
      std::size_t place = count++;
      for (; place > 0 && children[place - 1].bound < child.bound; --place)
      {
        children[place] = children[place - 1];
      }
      children[place] = child;
    }
    for (std::size_t i = 0; i < count; ++i) descend(h - 1, children[i]);
  }
};

LatticeSearchResult BranchAndBoundSearch::search(
    const std::vector<mrpt::math::TPoint2D>& points) const
{
  Run run{*this, detail::BestLatticePoses(space_.options().refined), {}, 0};
  for (const std::uint32_t heading : space_.headings())
  {
    run.steps.push_back(
        detail::flatOffsets(space_.offsets(points, heading), space_.coarse().stride()));
  }
  const Level& top = levels_.back();
  std::vector<Run::Block> roots;
  for (std::uint32_t heading = 0; heading < run.steps.size(); ++heading)
  {
    for (std::uint32_t row = 0; row < top.block_rows; ++row)
    {
      for (std::uint32_t column = 0; column < top.block_columns; ++column)
      {
        if (!top.any_free[std::size_t{row} * top.block_columns + column]) continue;
        roots.push_back({run.boundOf(kTopLevel, heading, row, column), heading, row, column});
      }
    }
  }
  std::stable_sort(roots.begin(), roots.end(),
                   [](const Run::Block& a, const Run::Block& b) { return a.bound > b.bound; });
  for (const Run::Block& root : roots) run.descend(kTopLevel, root);
  return {run.best.sorted(), run.scored};
}
}  // namespace sigloc
