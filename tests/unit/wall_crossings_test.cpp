// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/WallCrossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "matching/dense/CellView.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kMargin = 0.4;  // [m] before its end, up to which a beam is tested
constexpr double kGrazed = 0.7;  // [cells] of a wall, up to which a beam may pass it

using Cell = std::pair<std::uint32_t, std::uint32_t>;  // column, row

/// A field of any shape and resolution with a few solid walls, on its border, too.
struct FewWalls
{
  DenseField field;
  std::vector<Cell> walls;
};

FewWalls fewWalls(std::mt19937& random)
{
  constexpr std::array kResolutions{0.005, 0.01, 0.05, 0.08, 0.2, 1.0};
  const auto below = [&](std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); };
  const std::uint32_t width = 1 + below(below(3) == 0 ? 4 : 300);
  const std::uint32_t height = 1 + below(below(3) == 0 ? 4 : 300);
  FewWalls made;
  made.field.frame = {{-7.25, 3.5}, kResolutions[below(kResolutions.size())], width, height};
  made.field.cells.assign(std::size_t{width} * height, DenseCell(CellState::free));
  for (std::uint32_t k = below(40); k > 0; --k)
  {
    const bool on_border = below(3) == 0;
    const Cell wall(on_border ? below(2) * (width - 1) : below(width), below(height));
    made.field.cells[std::size_t{wall.second} * width + wall.first] =
        DenseCell(CellState::solid_wall);
    made.walls.push_back(wall);
  }
  return made;
}

/// How far [cells] a beam runs in a cell that is wider by `by` on each side, from its origin to its
/// tested end. Negative: it is not met.
double runIn(const Cell& cell, const TPoint2D& origin, const TPoint2D& direction, double length,
             double by)
{
  double enters = 0;
  double leaves = length;
  const auto clip = [&](double from, double along, double low)
  {
    const double first = (low - by - from) / along;
    const double second = (low + 1 + by - from) / along;
    enters = std::max(enters, std::min(first, second));
    leaves = std::min(leaves, std::max(first, second));
  };
  clip(origin.x, direction.x, cell.first);
  clip(origin.y, direction.y, cell.second);
  return leaves - enters;
}

/// Beams from one place in a field or beside it.
DenseScan scanIn(const RasterFrame& frame, std::mt19937& random)
{
  std::uniform_real_distribution<double> share(0, 1);
  const double most = (1.5 * std::max(frame.width, frame.height) + 5) * frame.resolution + kMargin;
  DenseScan scan;
  scan.origins = {TPoint2D(0, 0)};
  scan.spaced = WallCrossings::kRays;
  for (std::size_t i = 0; i < scan.spaced; ++i)
  {
    const double angle = 2 * M_PI * share(random);
    const double range = most * share(random);
    scan.x.push_back(static_cast<float>(range * std::cos(angle)));
    scan.y.push_back(static_cast<float>(range * std::sin(angle)));
    scan.origin.push_back(0);
  }
  return scan;
}

/// How many beams met a wall, or must have, of those that were compared.
struct Compared
{
  int hit = 0, missed = 0, ghosts = 0;
};

/// Compares with a walk through all walls. What rounding can decide is left out.
void compare(const FewWalls& at, const DenseScan& scan, const TPose2D& pose, std::uint64_t bits,
             Compared& out)
{
  const RasterFrame& frame = at.field.frame;
  const double rounding = 0.01 + 3e-5 / frame.resolution;
  const Placement place(pose);
  const auto inCells = [&](float x, float y)
  {
    return (TPoint2D(static_cast<double>(place.placedX(x, y)),
                     static_cast<double>(place.placedY(x, y))) -
            frame.origin) *
           (1 / frame.resolution);
  };
  const TPoint2D origin = inCells(0, 0);
  for (std::size_t i = 0; i < scan.size(); ++i)
  {
    const TPoint2D beam = inCells(scan.x[i], scan.y[i]) - origin;
    const double length = beam.norm() - kMargin / frame.resolution;
    double touched = -std::numeric_limits<double>::infinity();
    double inside = touched;
    for (const Cell& wall : at.walls)
    {
      const TPoint2D direction = beam * (1 / beam.norm());
      touched = std::max(touched, runIn(wall, origin, direction, length + rounding, rounding));
      inside = std::max(inside, runIn(wall, origin, direction, length, -rounding));
    }
    const bool is_hit = (bits >> i & 1U) != 0;
    const bool must_hit = inside >= kGrazed + 2 * rounding;
    out.hit += must_hit && is_hit ? 1 : 0;
    out.missed += must_hit && !is_hit ? 1 : 0;
    out.ghosts += touched < 0 && is_hit ? 1 : 0;
  }
}

TEST(WallCrossings, AreThoseOfAWalkThroughAllWalls)
{
  std::mt19937 random(611);
  std::uniform_real_distribution<double> share(-0.2, 1.2);
  Compared compared;
  for (int k = 0; k < 400; ++k)
  {
    const FewWalls at = fewWalls(random);
    const RasterFrame& frame = at.field.frame;
    const WallCrossings crossings(at.field);
    for (int j = 0; j < 5; ++j)
    {
      const DenseScan scan = scanIn(frame, random);
      const TPose2D pose(frame.origin.x + share(random) * frame.width * frame.resolution,
                         frame.origin.y + share(random) * frame.height * frame.resolution,
                         6 * share(random));
      compare(at, scan, pose, crossings.throughBits(scan, pose, WallCrossings::kRays), compared);
    }
  }
  EXPECT_GT(compared.hit, 5000);
  EXPECT_EQ(compared.missed, 0);
  EXPECT_EQ(compared.ghosts, 0);
}
}  // namespace
}  // namespace sigloc
