// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

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
  /// A wall piece as weighted second moments of all its sightings, plus its extent. Eq. (2.6)
  struct MergedSegment
  {
    double weight = 0;  ///< [m], summed length of the sightings
    mrpt::math::TPoint2D weighted_sum;
    double xx = 0, xy = 0, yy = 0;  ///< raw second moments
    Feature line;  ///< current estimate
    std::uint32_t sightings = 0;
    std::uint32_t last_scan = 0;
  };
  /// Any other feature as running means of its sightings. Eq. (2.7)
  struct MergedPlace
  {
    Feature feature;
    double cosine_sum = 0, sine_sum = 0;
    std::uint32_t count = 1;  ///< of observations; several of one scan are one sighting
    std::uint32_t last_scan = 0;
  };
  explicit FeatureMerger(const MapBuildingOptions& options) : options_(options) {}
  /// Continues from the merged features of another merger.
  FeatureMerger(const MapBuildingOptions& options, std::vector<MergedSegment> segments,
                std::vector<MergedPlace> places);

  /// Adds the features of one scan, given in the map frame.
  void add(const std::vector<Feature>& features_in_map);

  /// Returns the merged features that were seen often enough. The ends of walls that meet in convex
  /// corners are added to the wall ends.
  std::vector<Feature> features() const;

  const std::vector<MergedSegment>& segments() const { return segments_; }
  const std::vector<MergedPlace>& places() const { return places_; }

 private:
  using Cells = std::unordered_map<std::uint64_t, std::vector<std::uint32_t>>;

  void addSegment(const Feature& segment);
  void addPlace(const Feature& place);
  void registerPlace(std::uint32_t index);
  void absorb(MergedSegment& merged, const Feature& segment);
  bool fits(const Feature& mapped, const Feature& segment, double& offset) const;
  void registerSegment(std::uint32_t index, const Feature& segment);

  MapBuildingOptions options_;
  std::uint32_t scan_ = 0;
  std::vector<MergedSegment> segments_;
  std::vector<MergedPlace> places_;
  Cells segment_cells_;
  Cells place_cells_;
};
}  // namespace sigloc
