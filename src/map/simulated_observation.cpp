// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/simulated_observation.h"

#include <cmath>

#include "map/RayCaster.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr std::size_t kBeams = 360;
constexpr double kRange = 30.0;  // [m] of the beams

bool isFree(const DenseField& field, const TPoint2D& place)
{
  const DenseCell* cell = cellAt(field, place);
  return cell != nullptr && cell->state() == CellState::free;
}
}  // namespace

ObservedScene sceneOfMap(const FeatureMap& map)
{
  ObservedScene scene;
  scene.features = map.features();
  const TPoint2D origin(0, 0);
  if (!map.field() || !isFree(*map.field(), origin)) return scene;
  scene.sensor_origins.push_back(origin);
  const RayCaster caster(*map.field());
  for (std::size_t i = 0; i < kBeams; ++i)
  {
    const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(kBeams);
    const auto range = caster.cast(origin, angle, kRange);
    if (!range) continue;
    scene.beams.push_back({{*range * std::cos(angle), *range * std::sin(angle)}, 0});
  }
  return scene;
}
}  // namespace sigloc
