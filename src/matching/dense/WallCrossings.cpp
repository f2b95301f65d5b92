// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/WallCrossings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/simd.h"
#include "matching/dense/CellView.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr float kMargin = 0.4F;  // [m] before its end, up to which a beam is tested, eq. (6.8)
constexpr float kBeyondRim = 0.7F;  // [cells] added to each step; a grazed cell is no wall
constexpr float kTiny = 1e-6F;  // [cells] avoids a division by zero

constexpr std::size_t kRays = WallCrossings::kRays;

/// Beams in cells of the frame, from its origin.
struct Rays
{
  std::size_t count;  // a multiple of eight
  std::array<float, kRays> x, y;
  std::array<float, kRays> dx, dy;  // unit vectors
  std::array<float, kRays> start, length;  // along the ray: where its part in the frame is
  std::array<float, kRays> per_column, per_row;  // signed length of the ray per column and row
};

/// Returns the first `count` beams, up to the margin before their ends and within the
/// frame. Rays that fill up the last eight have no length.
Rays raysOf(const RasterFrame& frame, const DenseScan& scan, const Placement& place,
            std::size_t count)
{
  const auto scale = static_cast<float>(1.0 / frame.resolution);
  const auto width = static_cast<float>(frame.width);
  const auto height = static_cast<float>(frame.height);
  const auto x0 = static_cast<float>(frame.origin.x);
  const auto y0 = static_cast<float>(frame.origin.y);
  Rays rays;
  rays.count = (count + kWideFloats - 1) / kWideFloats * kWideFloats;
  for (std::size_t i = 0; i < count; ++i)
  {
    const TPoint2D& origin = scan.origins[scan.origin[i]];
    const auto ox = static_cast<float>(origin.x);
    const auto oy = static_cast<float>(origin.y);
    rays.x[i] = (place.placedX(ox, oy) - x0) * scale;
    rays.y[i] = (place.placedY(ox, oy) - y0) * scale;
    rays.dx[i] = (place.placedX(scan.x[i], scan.y[i]) - x0) * scale - rays.x[i];
    rays.dy[i] = (place.placedY(scan.x[i], scan.y[i]) - y0) * scale - rays.y[i];
  }
  for (std::size_t i = count; i < rays.count; ++i)
  {
    rays.x[i] = rays.y[i] = rays.dx[i] = rays.dy[i] = 0;
  }
  for (std::size_t i = 0; i < rays.count; ++i)
  {
    const float length =
        std::max(std::sqrt(rays.dx[i] * rays.dx[i] + rays.dy[i] * rays.dy[i]), kTiny);
    rays.dx[i] /= length;
    rays.dy[i] /= length;
    rays.per_column[i] = 1.0F / (rays.dx[i] + std::copysign(kTiny, rays.dx[i]));
    rays.per_row[i] = 1.0F / (rays.dy[i] + std::copysign(kTiny, rays.dy[i]));
    // Beyond the frame a beam meets nothing.
    const float left = -rays.x[i] * rays.per_column[i];
    const float right = (width - rays.x[i]) * rays.per_column[i];
    const float bottom = -rays.y[i] * rays.per_row[i];
    const float top = (height - rays.y[i]) * rays.per_row[i];
    rays.start[i] = std::max(0.0F, std::max(std::min(left, right), std::min(bottom, top)));
    rays.length[i] =
        std::min(length - kMargin * scale, std::min(std::max(left, right), std::max(bottom, top)));
  }
  return rays;
}

/// Finds, for eight rays that have advanced by `along` [cells], which of them are in a solid wall.
/// Also finds how far the others may go on: to the rim of what is clear around them, and a little
/// beyond.
inline void lookAround(const RasterFrame& frame, const ClearBlocks& clear_blocks, const Rays& rays,
                       std::size_t first, const WideFloat& along, WideInt& in_wall,
                       WideFloat& clear)
{
  static_assert(ClearBlocks::kSide == 2, "the lowest bits of column and row tell cells of a block");
  WideFloat x, y, dx, dy, per_column, per_row;
  loadWide(&rays.x[first], kWideFloats, x);
  loadWide(&rays.y[first], kWideFloats, y);
  loadWide(&rays.dx[first], kWideFloats, dx);
  loadWide(&rays.dy[first], kWideFloats, dy);
  loadWide(&rays.per_column[first], kWideFloats, per_column);
  loadWide(&rays.per_row[first], kWideFloats, per_row);
  x += along * dx;
  y += along * dy;
  const WideInt column = __builtin_convertvector(x, WideInt);
  const WideInt row = __builtin_convertvector(y, WideInt);
  const auto width = static_cast<std::int32_t>(frame.width);
  const auto height = static_cast<std::int32_t>(frame.height);
  const WideInt is_inside = (column >= 0) & (row >= 0) & (column < width) & (row < height);
  const WideInt block_column = column >> 1;
  const WideInt block_row = row >> 1;
  WideInt block;
  if (clear_blocks.isTiled())
  {
    static_assert(ClearBlocks::kOutside == 0);
    clear_blocks.loadTiled(block_column & is_inside, block_row & is_inside, block);
    block &= is_inside;
  }
  else
  {
    const std::uint8_t* bytes = clear_blocks.whole();
    const std::int32_t outside = clear_blocks.width() * clear_blocks.height();
    const WideInt at =
        ((block_row * clear_blocks.width() + block_column) & is_inside) | (outside & ~is_inside);
    loadWide(bytes, at, block);
  }
  // Beside a wall, and outside, only the own cell is known to be clear. Elsewhere all blocks up to
  // the nearest with a wall are.
  const WideInt beside_wall = block <= std::int32_t{ClearBlocks::kWalls};
  const WideInt in_row = 1 + (column & 1);
  const WideInt own_bit = (row & 1) != 0 ? in_row << ClearBlocks::kSide : in_row;
  in_wall = beside_wall & ((block & own_bit) != 0);
  const WideFloat blocks =
      __builtin_convertvector(block - std::int32_t{ClearBlocks::kWalls}, WideFloat);
  const WideFloat reach = beside_wall ? WideFloat{} + 0.5F : 2.0F * blocks - 1.0F;
  const WideFloat middle_x = beside_wall ? __builtin_convertvector(column, WideFloat) + 0.5F
                                         : __builtin_convertvector(column | 1, WideFloat);
  const WideFloat middle_y = beside_wall ? __builtin_convertvector(row, WideFloat) + 0.5F
                                         : __builtin_convertvector(row | 1, WideFloat);
  const WideFloat right = x - middle_x;
  const WideFloat up = y - middle_y;
  const WideFloat to_column =
      reach * (per_column < 0.0F ? -per_column : per_column) - right * per_column;
  const WideFloat to_row = reach * (per_row < 0.0F ? -per_row : per_row) - up * per_row;
  const WideFloat to_rim = to_column < to_row ? to_column : to_row;
  clear = (to_rim > 0.0F ? to_rim : WideFloat{}) + kBeyondRim;
}
}  // namespace

WallCrossings::WallCrossings(const DenseField& field) : frame_(field.frame), clear_blocks_(field) {}

std::uint64_t WallCrossings::throughBits(const DenseScan& scan, const TPose2D& pose,
                                         std::size_t beams) const
{
  return crossings(scan, Placement(pose), std::min({beams, kRays, scan.size()}));
}

/// Returns which of the first `count` beams meet a solid wall, as bits. They advance eight at a
/// time, and the groups of eight in turn. A ray's next look-up waits for its last one, but not for
/// those of other rays.
SIGLOC_WIDE_VECTORS std::uint64_t WallCrossings::crossings(const DenseScan& scan,
                                                           const Placement& place,
                                                           std::size_t count) const
{
  struct Eight
  {
    std::size_t first;
    WideFloat along;  // [cells] by which they have advanced
    WideInt under_way;  // all bits set for those that still advance
  };
  const Rays rays = raysOf(frame_, scan, place, count);
  std::array<Eight, kRays / kWideFloats> eights;
  std::size_t advancing = 0;
  for (std::size_t i = 0; i < rays.count; i += kWideFloats)
  {
    WideFloat start, length;
    loadWide(&rays.start[i], kWideFloats, start);
    loadWide(&rays.length[i], kWideFloats, length);
    eights[advancing++] = {i, start, start < length};
  }
  std::array<WideInt, kRays / kWideFloats> crossed{};  // all bits set for those that meet a wall
  while (advancing > 0)
  {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < advancing; ++k)
    {
      Eight eight = eights[k];
      const WideFloat before = eight.along;
      WideInt in_wall;
      WideFloat clear;
      WideFloat length;
      lookAround(frame_, clear_blocks_, rays, eight.first, eight.along, in_wall, clear);
      loadWide(&rays.length[eight.first], kWideFloats, length);
      eight.along += clear;
      crossed[eight.first / kWideFloats] |= eight.under_way & in_wall;
      // A ray stops where it is so far away that a step is lost in rounding.
      eight.under_way &= ~in_wall & (eight.along < length) & (eight.along > before);
      eights[kept] = eight;
      kept += anyOf(eight.under_way) ? 1 : 0;
    }
    advancing = kept;
  }
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < rays.count; ++i)
  {
    const bool meets = crossed[i / kWideFloats][i % kWideFloats] != 0;
    bits |= static_cast<std::uint64_t>(meets) << i;
  }
  return bits;
}
}  // namespace sigloc
