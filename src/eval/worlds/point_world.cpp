// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "eval/worlds/world_generators.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
/// Puts the points of one square patch, turned by quarters, in place of those of others.
void repeatPatch(World& world, std::uint32_t copies, Random& random)
{
  constexpr double kSide = 16;  // [m]
  const auto columns = static_cast<std::size_t>((world.bounds.x_max - world.bounds.x_min) / kSide);
  if (copies < 2) return;
  if (copies > columns * columns)
  {
    throw std::invalid_argument("points: the world is too small for so many patches");
  }
  const auto patch_of = [&](const TPoint2D& p)
  {
    const auto column = static_cast<std::size_t>((p.x - world.bounds.x_min) / kSide);
    const auto row = static_cast<std::size_t>((p.y - world.bounds.y_min) / kSide);
    return column < columns && row < columns ? row * columns + column : columns * columns;
  };
  std::vector<std::size_t> patches(columns * columns);
  for (std::size_t k = 0; k < patches.size(); ++k) patches[k] = k;
  for (std::size_t k = 0; k < copies; ++k)
  {
    std::swap(patches[k], patches[k + random.index(patches.size() - k)]);
  }
  patches.resize(copies);
  const auto middle_of = [&](std::size_t patch)
  {
    const std::size_t column = patch % columns;
    const std::size_t row = patch / columns;
    return TPoint2D(world.bounds.x_min + kSide * (static_cast<double>(column) + 0.5),
                    world.bounds.y_min + kSide * (static_cast<double>(row) + 0.5));
  };
  std::vector<TPoint2D> pattern;
  std::vector<TPoint2D> kept;
  for (const TPoint2D& p : world.points)
  {
    const std::size_t patch = patch_of(p);
    if (patch == patches.front()) pattern.push_back(p - middle_of(patch));
    const bool replaced = std::find(patches.begin(), patches.end(), patch) != patches.end();
    if (!replaced) kept.push_back(p);
  }
  for (std::size_t k = 0; k < copies; ++k)
  {
    for (TPoint2D p : pattern)
    {
      for (std::size_t turn = 0; turn < k % 4; ++turn) p = {-p.y, p.x};
      kept.push_back(middle_of(patches[k]) + p);
    }
  }
  world.points = std::move(kept);
}
}  // namespace

World detail::makePoints(const WorldOptions& options, Random& random)
{
  World world;
  const double density = options.density > 0 ? options.density : 0.1;
  const double side = std::sqrt(static_cast<double>(options.points) / density);
  world.bounds = {0, side, 0, side};
  world.points.reserve(options.points);
  for (std::uint32_t i = 0; i < options.points; ++i)
  {
    const double x = random.uniform(0, side);
    world.points.push_back({x, random.uniform(0, side)});
  }
  repeatPatch(world, options.patches, random);
  return world;
}
}  // namespace sigloc
