// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eval/worlds/Random.h"
#include "sigloc/features/Feature.h"
#include "sigloc/map/FeatureMap.h"

#include <array>
#include <cstddef>
#include <vector>

namespace sigloc
{
/// A world of bare features, without scans: features spread evenly over a square, a map of them
/// with errors, and observations with noise, misses and spurious features. The defaults are the
/// standard world of the growth study.
struct FeatureWorldOptions
{
  double density = 0.1;  ///< [1/m^2]
  double range = 8;  ///< [m], within which features are seen
  double observation_sigma = 0.05;  ///< [m], of each coordinate
  double angle_sigma = 0.01;  ///< [rad], of segments, corners and wall ends
  double map_sigma = 0.02;  ///< [m], of each coordinate
  double map_angle_sigma = 0.002;  ///< [rad]
  double detection = 0.87;  ///< share of the features in range that are seen
  double spurious = 0.3;  ///< share of the observed features that are not in the map
  std::array<double, kFeatureTypes> type_weights{1};  ///< relative frequency of each type
};

struct FeatureWorld
{
  double side = 0;  ///< [m]; the world covers [0, side] x [0, side]
  std::vector<Feature> truth;
  std::vector<Feature> mapped;  ///< the same features with the map's errors and covariances
};

/// Returns a world of `count` features.
FeatureWorld makeFeatureWorld(std::size_t count, const FeatureWorldOptions& options,
                              Random& random);

/// Returns a pose in the world, at least the range away from its border where it is large enough.
mrpt::math::TPose2D randomPose(const FeatureWorld& world, const FeatureWorldOptions& options,
                               Random& random);

/// Returns the features seen from a pose, in the robot frame, in random order. With `wanted` > 0
/// the visible features are thinned to about that many, spurious ones included.
std::vector<Feature> observeFeatures(const FeatureWorld& world,
                                     const mrpt::math::TPose2D& map_from_robot,
                                     const FeatureWorldOptions& options, Random& random,
                                     std::size_t wanted = 0);
}  // namespace sigloc
