// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/CoarseField.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "matching/dense/likelihood_table.h"

namespace sigloc
{
namespace
{
constexpr double kCell = 0.1;  // [m] cell of the likelihoods
constexpr double kLargestCell = 0.2;  // [m] cell where the raster would be larger than the cache
constexpr std::size_t kCachedCells = 2U << 20U;  // cells that the cache holds, one byte each
constexpr double kBorder = 20.0;  // [m] around the map, where returns need no check of the range
constexpr double kStandingCell = 0.5;  // [m] cell that must have free space in it or beside it
constexpr std::uint8_t kStanding = CoarseField::kStanding;

std::uint32_t ratioOf(const RasterFrame& coarse, const RasterFrame& fine)
{
  return static_cast<std::uint32_t>(std::lround(coarse.resolution / fine.resolution));
}

std::size_t cellCount(const RasterFrame& frame)
{
  return static_cast<std::size_t>(frame.width) * frame.height;
}

/// Returns the raster of the likelihoods, small enough to stay in the cache.
RasterFrame likelihoodFrame(const RasterFrame& field)
{
  const RasterFrame frame = coarserFrame(field, kCell);
  return cellCount(frame) <= kCachedCells ? frame : coarserFrame(field, kLargestCell);
}

/// Calls `visit(column, begin, end)` for each column of blocks that a row of stored cells, from
/// `first` on, passes through: [begin, end) are the cells in it, counted from the first one.
template <class Visit>
void forEachBlock(std::uint32_t first, std::uint32_t width, std::uint32_t ratio, const Visit& visit)
{
  std::uint32_t column = first / ratio;
  std::uint32_t end = (column + 1) * ratio - first;
  for (std::uint32_t begin = 0; begin < width; begin = end, end += ratio, ++column)
    visit(column, begin, std::min(end, width));
}

/// True where all cells are far from any wall.
bool areFar(const DenseCell* cells, std::uint32_t count)
{
  std::uint8_t common = DenseCell::kFar;
  for (std::uint32_t x = 0; x < count; ++x)
    common = static_cast<std::uint8_t>(common & cells[x].code());
  return common == DenseCell::kFar;
}
}  // namespace

RasterFrame coarserFrame(const RasterFrame& fine, double cell)
{
  const auto ratio = static_cast<std::uint32_t>(std::max(1.0, std::round(cell / fine.resolution)));
  RasterFrame frame;
  frame.origin = fine.origin;
  frame.resolution = fine.resolution * ratio;
  frame.width = (fine.width + ratio - 1) / ratio;
  frame.height = (fine.height + ratio - 1) / ratio;
  return frame;
}

CoarseField::Standing::Standing(const DenseField& field)
    : frame_(coarserFrame(field.frame, kStandingCell)),
      blocks_(frame_.width, frame_.height, field.isTiled())
{
  const std::uint32_t ratio = ratioOf(frame_, field.frame);
  ByteRaster free(frame_.width, frame_.height, field.isTiled());
  for (const StoredCells& stored : storedCells(field))
  {
    for (std::uint32_t y = 0; y < stored.height; ++y)
    {
      const DenseCell* row = stored.row(y);
      const std::uint32_t block_row = (stored.y + y) / ratio;
      forEachBlock(stored.x, stored.width, ratio,
                   [&](std::uint32_t column, std::uint32_t begin, std::uint32_t end)
                   {
                     bool has_free = false;
                     for (std::uint32_t x = begin; x < end; ++x)
                       has_free |= row[x].state() == CellState::free;
                     if (has_free) free.at(column, block_row) = kStanding;
                   });
    }
  }
  free.forEachSet(
      [&](std::uint32_t x, std::uint32_t y)
      {
        for (std::uint32_t j = y == 0 ? 0 : y - 1; j < std::min(y + 2, frame_.height); ++j)
        {
          for (std::uint32_t i = x == 0 ? 0 : x - 1; i < std::min(x + 2, frame_.width); ++i)
          {
            blocks_.at(i, j) = kStanding;
          }
        }
      });
}

CoarseField::CoarseField(const DenseField& field, const Standing& standing)
    : CoarseField(field, standing, likelihoodFrame(field.frame))
{
}

CoarseField::CoarseField(const DenseField& field, const Standing& standing, double cell)
    : CoarseField(field, standing, coarserFrame(field.frame, cell))
{
}

CoarseField::CoarseField(const DenseField& field, const Standing& standing,
                         const RasterFrame& frame)
    : frame_(frame)
{
  fillLikelihoods(field);
  mark(standing, field.frame);
}

void CoarseField::fillLikelihoods(const DenseField& field)
{
  const std::uint32_t ratio = ratioOf(frame_, field.frame);
  border_ = std::min(static_cast<std::uint32_t>(std::ceil(kBorder / frame_.resolution)),
                     std::max(frame_.width, frame_.height));
  frame_.origin.x -= border_ * frame_.resolution;
  frame_.origin.y -= border_ * frame_.resolution;
  frame_.width += 2 * border_;
  frame_.height += 2 * border_;
  likelihoods_ = ByteRaster(frame_.width, frame_.height,
                            field.isTiled() && cellCount(frame_) > kMostWholeCells);
  std::array<std::uint8_t, DenseCell::kFar + 1> bytes{};
  for (std::size_t d = 0; d < bytes.size(); ++d)
  {
    const auto byte = static_cast<std::uint8_t>(std::lround(255.0F * coarseTable()[d]));
    bytes[d] = byte & static_cast<std::uint8_t>(~kStanding);
  }
  // Most of a map is far from walls.
  constexpr std::uint32_t kPiece = 64;
  const bool far_is_nothing = bytes[DenseCell::kFar] == 0;
  for (const StoredCells& stored : storedCells(field))
  {
    for (std::uint32_t y = 0; y < stored.height; ++y)
    {
      const std::uint32_t coarse_row = (stored.y + y) / ratio + border_;
      for (std::uint32_t from = 0; from < stored.width; from += kPiece)
      {
        const DenseCell* cells = stored.row(y) + from;
        const std::uint32_t count = std::min(kPiece, stored.width - from);
        if (far_is_nothing && areFar(cells, count)) continue;
        forEachBlock(stored.x + from, count, ratio,
                     [&](std::uint32_t column, std::uint32_t begin, std::uint32_t end)
                     {
                       std::uint8_t byte = 0;
                       for (std::uint32_t x = begin; x < end; ++x)
                         byte = std::max(byte, bytes[cells[x].distance()]);
                       if (byte == 0) return;
                       std::uint8_t& best = likelihoods_.at(column + border_, coarse_row);
                       best = std::max(best, byte);
                     });
      }
    }
  }
}

void CoarseField::mark(const Standing& standing, const RasterFrame& fine)
{
  const std::uint32_t ratio = ratioOf(frame_, fine);
  const std::uint32_t block_ratio = ratioOf(standing.frame_, fine);
  const std::uint32_t width = frame_.width - 2 * border_;
  const std::uint32_t height = frame_.height - 2 * border_;
  const auto first_in = [&](std::uint32_t block)
  { return (block * block_ratio + ratio - 1) / ratio; };
  standing.blocks_.forEachSet(
      [&](std::uint32_t x, std::uint32_t y)
      {
        for (std::uint32_t j = first_in(y); j < std::min(first_in(y + 1), height); ++j)
        {
          for (std::uint32_t i = first_in(x); i < std::min(first_in(x + 1), width); ++i)
          {
            likelihoods_.at(i + border_, j + border_) |= kStanding;
          }
        }
      });
  likelihoods_.finish();
}
}  // namespace sigloc
