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
/// A map that is learnt look by look. Each costs what it sees, however many came before: its
/// features are merged with those around, its beams counted, and nothing else of it is kept, so
/// that memory grows with the map and not with the number of looks.
///
///     MapBuilder builder;
///     builder.add({map_from_robot, scans});   // as often as the robot looks
///     const FeatureMap map = builder.map();   // whenever it is needed
///
/// The map is the one that `buildMapFromScans` makes of the same looks in the same order. On top of
/// a map that was there before, its features stay, new ones are added where it has none within the
/// merge distances, and the looks overwrite its raster wherever they know a cell; a map without a
/// field keeps having none. \cite algorithm sections 2 and 6
class MapBuilder
{
 public:
  /// Throws std::invalid_argument for options outside their ranges.
  explicit MapBuilder(const MapBuildingOptions& options = {},
                      std::shared_ptr<const FeatureMap> base = nullptr);

  /// Takes in one look. Throws std::invalid_argument, with nothing taken in, for a pose that is not
  /// finite or too far from the rest, or an inconsistent scan.
  void add(const PosedScans& look, const FeatureExtractorOptions& extraction = {});

  /// True before the first return of a laser.
  bool empty() const { return counts_.empty(); }

  /// The features so far, the base's first.
  std::vector<Feature> features() const;

  /// Brings the dense field up to date and returns it, with some unknown cells around it; null
  /// where the base has none or there was no return yet. Valid, and unchanged, until the next
  /// `add`.
  const DenseField* field();

  /// Returns the map so far.
  FeatureMap map(const MapProvenance& provenance = {});

  std::uint64_t cellsCounted() const { return counts_.cellsCounted(); }  ///< work done, in cells
  std::uint64_t cellsSolved() const { return field_.cellsSolved(); }  ///< of the field, likewise

  // For storing.
  const MapBuildingOptions& options() const { return options_; }
  const FeatureMerger& merger() const { return merger_; }
  const BeamCounts& counts() const { return counts_; }
  /// Goes on where stored ones have ended; for an empty builder.
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
