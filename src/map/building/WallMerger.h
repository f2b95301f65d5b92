// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/CellHash.h"
#include "sigloc/features/Feature.h"
#include "sigloc/map/map_building.h"

namespace sigloc
{
/// A piece of wall as weighted second moments of all its sightings, plus its extent. Eq. (2.6)
struct MergedWall
{
  double weight = 0;  ///< [m], summed length of the sightings
  mrpt::math::TPoint2D weighted_sum;
  double xx = 0, xy = 0, yy = 0;  ///< raw second moments
  Feature line;  ///< current estimate
  std::uint32_t sightings = 0;
  std::uint32_t last_scan = 0;
};

/// Merges the segments of many scans into the walls of a map, through a spatial hash. Each
/// insertion costs O(local density). \cite algorithm section 2, "From scans to a map"
class WallMerger
{
 public:
  explicit WallMerger(const MapBuildingOptions& options) : options_(options) {}
  /// Continues from the walls of another merger.
  WallMerger(const MapBuildingOptions& options, std::vector<MergedWall> walls);

  /// Adds a segment that was seen in a scan, given in the map frame. Scans are counted from 1.
  void add(const Feature& segment, std::uint32_t scan);

  const std::vector<MergedWall>& walls() const { return walls_; }

  /// Returns the walls with at least so many sightings, merged once more, the longest seen first.
  /// Sightings that came in an unlucky order leave the same wall twice.
  std::vector<MergedWall> mergedAgain(std::uint32_t least_sightings) const;

 private:
  std::uint32_t bestFor(const Feature& segment) const;
  bool fits(const Feature& mapped, const Feature& segment, double& offset) const;
  void enter(std::uint32_t index);

  static constexpr double kCell = 1.0;  // [m] of the hash over walls

  MapBuildingOptions options_;
  std::vector<MergedWall> walls_;
  CellHash cells_{kCell};
};
}  // namespace sigloc
