// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <filesystem>
#include <vector>

#include "sigloc/features/Feature.h"
#include "sigloc/geometry/GaussianPose.h"

namespace sigloc
{
/// One step of a landmark log: the motion since the step before and the observations after it. The
/// true pose and identities are for scoring and map making only.
struct LandmarkStep
{
  MotionIncrement motion;
  std::vector<Feature> observed;  ///< robot frame
  std::vector<int> identities;  ///< of `observed`, -1 for none; empty where the log has none
  mrpt::math::TPose2D truth;  ///< map_from_robot
  /// False where the truth may be too inaccurate to judge an answer by it.
  bool truth_sure = true;
};

struct LandmarkData
{
  std::vector<LandmarkStep> steps;
  std::vector<Feature> map;  ///< the given map
  MapErrorModel map_error;
  std::vector<std::filesystem::path> files;
};

/// The DLR building (discs seen by a camera) from its folder.
/// Throws std::runtime_error ("path: reason").
LandmarkData readDlr(const std::filesystem::path& folder);

/// Victoria Park (trees as circles, taken from the raw scans) from its folder. The truth is a
/// filter's estimate. It is sure where its standard deviation is 0.5 m at most and it does not jump
/// from the step before or to the next. A jump differs from the odometry by more than 0.5 m or 5
/// degrees. Throws std::runtime_error ("path: reason").
LandmarkData readVictoriaPark(const std::filesystem::path& folder);

/// The map of the features that steps [0, count) observed, by true poses and identities. A feature
/// with an identity is real, so one sighting is enough.
std::vector<Feature> mapFromSteps(const LandmarkData& data, std::size_t count);
}  // namespace sigloc
