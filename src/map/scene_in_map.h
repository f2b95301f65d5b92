// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sigloc/features/ObservedScene.h"

namespace sigloc
{
/// Returns the features of a scene in the map frame.
inline std::vector<Feature> inMap(const ObservedScene& scene,
                                  const mrpt::math::TPose2D& map_from_robot)
{
  std::vector<Feature> features;
  features.reserve(scene.features.size());
  for (const Feature& feature : scene.features)
  {
    features.push_back(transformed(map_from_robot, feature));
  }
  return features;
}
}  // namespace sigloc
