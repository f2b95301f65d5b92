// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "map/building/BeamCounts.h"
#include "map/building/FeatureMerger.h"
#include "map/building/GrowingField.h"
#include "sigloc/map/FeatureMap.h"
#include "sigloc/map/map_building.h"

namespace sigloc
{
/// Builds a map scan by scan; all laser scans of one step count as one. The features of a scan are
/// merged with those around, its beams are counted, and nothing else is kept. So the cost of a scan
/// depends on what it sees, and memory grows with the map, not with the number of scans.
///
///     MapBuilder builder;
///     builder.add({map_from_robot, scans});   // for every scan
///     const FeatureMap map = builder.map();   // whenever it is needed
///
/// The map equals that of `buildMapFromScans` for the same scans in the same order. Where there is
/// a base map, its features stay, and new ones are added where it has none within the merge
/// distances. The scans overwrite its raster in all cells that they know. A base without a field
/// gets none. \cite algorithm sections 2 and 6
class MapBuilder
{
 public:
  /// Throws std::invalid_argument for options outside their ranges.
  explicit MapBuilder(const MapBuildingOptions& options = {},
                      std::shared_ptr<const FeatureMap> base = nullptr);

  /// Adds one scan. Throws std::invalid_argument, with nothing added, for a pose that is not finite
  /// or too far from the rest, or an inconsistent scan.
  void add(const PosedScans& posed, const FeatureExtractorOptions& extraction = {});

  /// True before the first return of a laser.
  bool empty() const { return counts_.empty(); }

  /// Returns the features so far, those of the base first.
  std::vector<Feature> features() const;

  /// Updates the dense field and returns it, with some unknown cells around it. It is null where
  /// the base has none, or before the first return. It stays valid and unchanged until the next
  /// `add`.
  const DenseField* field();

  /// Returns the map so far.
  FeatureMap map(const MapProvenance& provenance = {});

  std::uint64_t cellsCounted() const { return counts_.cellsCounted(); }  ///< work done, in cells
  std::uint64_t cellsSolved() const { return field_.cellsSolved(); }  ///< the same for the field

  // For storing.
  const MapBuildingOptions& options() const { return options_; }
  const FeatureMerger& merger() const { return merger_; }
  const BeamCounts& counts() const { return counts_; }
  /// Continues from a stored merger and stored counts; for an empty builder.
  void restore(FeatureMerger merger, BeamCounts counts);

 private:
  bool hasField() const { return !base_ || base_->field().has_value(); }

  MapBuildingOptions options_;
  std::shared_ptr<const FeatureMap> base_;
  FeatureMerger merger_;
  BeamCounts counts_;
  GrowingField field_;
};
}  // namespace sigloc
