// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SolidWalls.h"

#include <algorithm>
#include <cmath>

#include "CellView.h"
#include "QuickField.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kCell = 0.1;  // [m]
constexpr float kMargin = 0.4F;  // [m] before its end a beam must be clear of walls
constexpr float kBeyondRim =
    0.12F;  // [cells] that lead into the next cell; a grazed rim is no wall
constexpr float kTiny = 1e-6F;

/// Chessboard distance [cells] to the nearest zero cell, in two passes, exact up to 255.
void spreadRings(std::vector<std::uint8_t>& rings, std::uint32_t width, std::uint32_t height)
{
  const auto relax = [&](std::size_t cell, std::size_t neighbour)
  {
    if (rings[neighbour] + 1 < rings[cell])
    {
      rings[cell] = static_cast<std::uint8_t>(rings[neighbour] + 1);
    }
  };
  for (std::uint32_t y = 0; y < height; ++y)
  {
    for (std::uint32_t x = 0; x < width; ++x)
    {
      const std::size_t cell = static_cast<std::size_t>(y) * width + x;
      if (x > 0) relax(cell, cell - 1);
      if (y == 0) continue;
      relax(cell, cell - width);
      if (x > 0) relax(cell, cell - width - 1);
      if (x + 1 < width) relax(cell, cell - width + 1);
    }
  }
  for (std::uint32_t y = height; y-- > 0;)
  {
    for (std::uint32_t x = width; x-- > 0;)
    {
      const std::size_t cell = static_cast<std::size_t>(y) * width + x;
      if (x + 1 < width) relax(cell, cell + 1);
      if (y + 1 == height) continue;
      relax(cell, cell + width);
      if (x > 0) relax(cell, cell + width - 1);
      if (x + 1 < width) relax(cell, cell + width + 1);
    }
  }
}
}  // namespace

SolidWalls::SolidWalls(const DenseField& field)
    : field_(field),
      frame_(coarserFrame(field.frame, kCell)),
      scale_(static_cast<float>(1.0 / frame_.resolution))
{
  const auto ratio =
      static_cast<std::uint32_t>(std::lround(frame_.resolution / field.frame.resolution));
  clear_rings_.assign(static_cast<std::size_t>(frame_.width) * frame_.height, 255);
  for (std::uint32_t y = 0; y < field.frame.height; ++y)
  {
    const DenseCell* row = &field.cells[static_cast<std::size_t>(y) * field.frame.width];
    std::uint8_t* rings = &clear_rings_[static_cast<std::size_t>(y / ratio) * frame_.width];
    for (std::uint32_t x = 0; x < field.frame.width; ++x)
    {
      if (row[x].state == CellState::solid_wall) rings[x / ratio] = 0;
    }
  }
  spreadRings(clear_rings_, frame_.width, frame_.height);
}

double SolidWalls::throughShare(const DenseScan& scan, const TPose2D& pose, std::size_t beams) const
{
  const std::size_t count = std::min(beams, scan.size());
  const Placement place(pose);
  std::size_t crossed = 0;
  for (std::size_t first = 0; first < count; first += kRays)
  {
    crossed += crossings(raysOf(scan, place, first, std::min(kRays, count - first)));
  }
  return static_cast<double>(crossed) / static_cast<double>(count);
}

/// The beams from `first` on, up to the margin before their ends.
SolidWalls::Rays SolidWalls::raysOf(const DenseScan& scan, const Placement& place,
                                    std::size_t first, std::size_t count) const
{
  const auto x0 = static_cast<float>(frame_.origin.x);
  const auto y0 = static_cast<float>(frame_.origin.y);
  Rays rays;
  rays.count = count;
  for (std::size_t i = 0; i < count; ++i)
  {
    const TPoint2D& origin = scan.origins[scan.origin[first + i]];
    const auto ox = static_cast<float>(origin.x);
    const auto oy = static_cast<float>(origin.y);
    rays.x[i] = (place.placedX(ox, oy) - x0) * scale_;
    rays.y[i] = (place.placedY(ox, oy) - y0) * scale_;
    rays.dx[i] = (place.placedX(scan.x[first + i], scan.y[first + i]) - x0) * scale_ - rays.x[i];
    rays.dy[i] = (place.placedY(scan.x[first + i], scan.y[first + i]) - y0) * scale_ - rays.y[i];
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const float length =
        std::max(std::sqrt(rays.dx[i] * rays.dx[i] + rays.dy[i] * rays.dy[i]), kTiny);
    rays.dx[i] /= length;
    rays.dy[i] /= length;
    rays.length[i] = length - kMargin * scale_;
    rays.per_column[i] = 1.0F / (rays.dx[i] + std::copysign(kTiny, rays.dx[i]));
    rays.per_row[i] = 1.0F / (rays.dy[i] + std::copysign(kTiny, rays.dy[i]));
  }
  return rays;
}

/// How many of the rays meet a solid wall. They advance in turns: a ray's next look-up waits for
/// its last, those of different rays don't wait for each other.
std::size_t SolidWalls::crossings(const Rays& rays) const
{
  const CellView cells(field_);
  std::array<float, kRays> along{};
  std::array<std::uint8_t, kRays> active;
  std::size_t count = 0;
  for (std::size_t i = 0; i < rays.count; ++i)
  {
    active[count] = static_cast<std::uint8_t>(i);
    count += rays.length[i] > 0 ? 1 : 0;
  }
  std::size_t crossed = 0;
  while (count > 0)
  {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count; ++k)
    {
      const std::uint8_t i = active[k];
      const float x = rays.x[i] + along[i] * rays.dx[i];
      const float y = rays.y[i] + along[i] * rays.dy[i];
      const auto column = static_cast<std::int32_t>(x);
      const auto row = static_cast<std::int32_t>(y);
      const std::uint8_t rings = ringsAt(column, row);
      float clear = 0;
      if (rings > 0)
      {
        // To the rim of the clear rings, and a little beyond.
        const float reach = static_cast<float>(rings) - 0.5F;
        const float right = x - static_cast<float>(column) - 0.5F;
        const float up = y - static_cast<float>(row) - 0.5F;
        const float per_column = rays.per_column[i];
        const float per_row = rays.per_row[i];
        clear = std::min(reach * std::abs(per_column) - right * per_column,
                         reach * std::abs(per_row) - up * per_row);
        clear = std::max(clear, 0.0F) + kBeyondRim;
      }
      else
      {
        clear = clearanceBesideWall(cells, x, y);
      }
      along[i] += clear;
      crossed += clear == 0 ? 1 : 0;
      active[kept] = i;
      kept += clear > 0 && along[i] < rays.length[i] ? 1 : 0;
    }
    count = kept;
  }
  return crossed;
}

/// How far [cells] a ray may advance from a place in a cell that holds a solid wall; 0: it met it.
float SolidWalls::clearanceBesideWall(const CellView& cells, float x, float y) const
{
  const auto coarse = static_cast<float>(frame_.resolution);
  const DenseCell& cell = cells.at(x * coarse + static_cast<float>(frame_.origin.x),
                                   y * coarse + static_cast<float>(frame_.origin.y));
  if (cell.state == CellState::solid_wall) return 0;
  const auto fine = static_cast<float>(field_.frame.resolution);
  constexpr auto kUnit = static_cast<float>(DenseField::kDistanceUnit);
  return scale_ * std::max(static_cast<float>(cell.distance) * kUnit - 1.42F * fine, 0.7F * fine);
}
}  // namespace sigloc
