// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
/// A pose that one map may have in another.
struct MapPose
{
  GaussianPose a_from_b;
  double weight = 0;  ///< share of the places of b whose view says so, in [0, 1]
  double explained = 0;  ///< of b's walls over mapped space of a, the share on walls of a
  double overlap = 0;  ///< share of b's walls that lie over mapped space of a
};

struct AlignmentOptions
{
  std::uint32_t places = 60;  ///< of b, whose views are looked for in a
};

/// Returns every pose of map b in map a that is possible, heaviest first; none where there is none.
///
/// Scans are simulated at places of b and relocated in a. Each candidate says where b would be.
/// Those that agree are gathered, and refined by all walls of b. Depends only on the maps and the
/// options. Throws std::invalid_argument for a map without a dense field or free space.
std::vector<MapPose> alignMaps(const std::shared_ptr<const FeatureMap>& a, const FeatureMap& b,
                               const AlignmentOptions& options,
                               const std::function<void(double share)>& progress = {});
}  // namespace sigloc
