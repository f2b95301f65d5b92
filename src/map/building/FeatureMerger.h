// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/CellHash.h"
#include "map/building/merged_features.h"
#include "map/building/WallMerger.h"
#include "sigloc/features/Feature.h"
#include "sigloc/map/map_building.h"

namespace sigloc
{
/// Merges the features of many scans into those of a map, through spatial hashes. Each insertion
/// costs O(local density). Memory grows with the number of distinct features.
/// \cite algorithm section 2, "From scans to a map"
class FeatureMerger
{
 public:
  explicit FeatureMerger(const MapBuildingOptions& options) : FeatureMerger(options, {}, {}) {}
  /// Continues from the merged features of another merger.
  FeatureMerger(const MapBuildingOptions& options, std::vector<MergedWall> walls,
                std::vector<MergedPlace> places);

  /// Adds the features of one scan, given in the map frame.
  void add(const std::vector<Feature>& features_in_map);

  /// Returns the features of the map, as mergedFeatures() does.
  std::vector<Feature> features() const;

  const std::vector<MergedWall>& walls() const { return walls_.walls(); }
  const std::vector<MergedPlace>& places() const { return places_; }

 private:
  void addPlace(const Feature& place);
  MergedPlace* placeFor(const Feature& place);

  MapBuildingOptions options_;
  std::uint32_t scan_ = 0;
  WallMerger walls_;
  std::vector<MergedPlace> places_;
  CellHash places_by_cell_;  // where they were seen first
};
}  // namespace sigloc
