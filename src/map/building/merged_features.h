// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "map/building/WallMerger.h"
#include "sigloc/features/Feature.h"
#include "sigloc/map/map_building.h"

namespace sigloc
{
constexpr double kMostPlaceTurn = 0.4;  // [rad] between sightings of one corner or wall end

/// Any feature but a wall as running means of its sightings. Eq. (2.7)
struct MergedPlace
{
  Feature feature;
  double cosine_sum = 0, sine_sum = 0;
  std::uint32_t count = 1;  ///< of observations; several of one scan are one sighting
  std::uint32_t last_scan = 0;
};

/// Returns the features of a map: the walls, and the places that were seen often enough. The ends
/// of walls that meet in convex corners are added to the wall ends. Circles that are parts of a
/// wall are left out. \cite algorithm section 2, "From scans to a map"
std::vector<Feature> mergedFeatures(const std::vector<MergedWall>& walls,
                                    const std::vector<MergedPlace>& places,
                                    const MapBuildingOptions& options);
}  // namespace sigloc
