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
    : field_(field), frame_(coarserFrame(field.frame, kCell))
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
  std::size_t through = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const TPoint2D& origin = scan.origins[scan.origin[i]];
    const auto ox = static_cast<float>(origin.x);
    const auto oy = static_cast<float>(origin.y);
    const float x = place.placedX(ox, oy);
    const float y = place.placedY(ox, oy);
    const float dx = place.placedX(scan.x[i], scan.y[i]) - x;
    const float dy = place.placedY(scan.x[i], scan.y[i]) - y;
    const float length = std::sqrt(dx * dx + dy * dy);
    if (length <= kMargin) continue;
    if (crossed(x, y, dx / length, dy / length, length - kMargin)) ++through;
  }
  return static_cast<double>(through) / static_cast<double>(count);
}

/// Whether a ray from (x, y) [m] along the unit vector (dx, dy) meets a solid wall within `length`.
bool SolidWalls::crossed(float x, float y, float dx, float dy, float length) const
{
  const CellView cells(field_);
  const auto scale = static_cast<float>(1.0 / frame_.resolution);
  const auto coarse = static_cast<float>(frame_.resolution);
  const auto fine = static_cast<float>(field_.frame.resolution);
  const auto x0 = static_cast<float>(frame_.origin.x);
  const auto y0 = static_cast<float>(frame_.origin.y);
  constexpr auto kUnit = static_cast<float>(DenseField::kDistanceUnit);
  float along = 0;
  while (along < length)
  {
    const float px = x + along * dx;
    const float py = y + along * dy;
    const float fx = (px - x0) * scale;
    const float fy = (py - y0) * scale;
    const bool inside = fx >= 0 && fy >= 0 && fx < static_cast<float>(frame_.width) &&
                        fy < static_cast<float>(frame_.height);
    if (!inside)
    {
      along += coarse;
      continue;
    }
    const std::uint8_t rings =
        clear_rings_[static_cast<std::size_t>(fy) * frame_.width + static_cast<std::size_t>(fx)];
    if (rings > 1)
    {
      along += coarse * static_cast<float>(rings - 1);
      continue;
    }
    const DenseCell& cell = cells.at(px, py);
    if (cell.state == CellState::solid_wall) return true;
    const float clear = static_cast<float>(cell.distance) * kUnit - 1.42F * fine;
    along += std::max(clear, 0.7F * fine);
  }
  return false;
}
}  // namespace sigloc
