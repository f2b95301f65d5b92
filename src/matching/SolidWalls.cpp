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
  std::vector<Ray> rays;
  rays.reserve(count);
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
    rays.push_back({x, y, dx / length, dy / length, length - kMargin, 0});
  }
  return static_cast<double>(crossings(rays)) / static_cast<double>(count);
}

/// How many of the rays meet a solid wall. They advance in turns: a ray's next look-up waits for
/// its last, those of different rays don't wait for each other.
std::size_t SolidWalls::crossings(std::vector<Ray>& rays) const
{
  const CellView cells(field_);
  std::size_t crossed = 0;
  std::size_t active = rays.size();
  while (active > 0)
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < active; ++i)
    {
      Ray ray = rays[i];
      const float clear =
          clearanceAt(cells, ray.x + ray.along * ray.dx, ray.y + ray.along * ray.dy);
      ray.along += clear;
      if (clear == 0) ++crossed;
      if (clear > 0 && ray.along < ray.length) rays[kept++] = ray;
    }
    active = kept;
  }
  return crossed;
}

/// How far [m] a ray may advance from (x, y) [m] without passing a solid wall; 0: it met one.
float SolidWalls::clearanceAt(const CellView& cells, float x, float y) const
{
  const auto coarse = static_cast<float>(frame_.resolution);
  const float fx = (x - static_cast<float>(frame_.origin.x)) * scale_;
  const float fy = (y - static_cast<float>(frame_.origin.y)) * scale_;
  const bool inside = fx >= 0 && fy >= 0 && fx < static_cast<float>(frame_.width) &&
                      fy < static_cast<float>(frame_.height);
  if (!inside) return coarse;
  const std::uint8_t rings =
      clear_rings_[static_cast<std::size_t>(fy) * frame_.width + static_cast<std::size_t>(fx)];
  if (rings > 1) return coarse * static_cast<float>(rings - 1);
  const DenseCell& cell = cells.at(x, y);
  if (cell.state == CellState::solid_wall) return 0;
  const auto fine = static_cast<float>(field_.frame.resolution);
  constexpr auto kUnit = static_cast<float>(DenseField::kDistanceUnit);
  return std::max(static_cast<float>(cell.distance) * kUnit - 1.42F * fine, 0.7F * fine);
}
}  // namespace sigloc
