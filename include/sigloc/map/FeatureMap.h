// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/features/Feature.h"
#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/map/DenseField.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sigloc
{
/// A line that carries one or more mapped segments facing the same way: fragments of one wall.
struct WallLine
{
  double direction = 0;  ///< [rad], normal into the free space
  double distance = 0;  ///< [m], n . p = distance
  std::vector<std::uint32_t> members;  ///< indices of segments, by position along the tangent
};

/// Links collinear fragments that face the same way into walls; openings up to 4 m are bridged.
std::vector<WallLine> linkWalls(const std::vector<Feature>& features);

/// Where a map came from; stored so that a `.sigmap` is rebuilt only when its source has changed.
struct MapProvenance
{
  std::string source_path;
  std::string source_checksum;  ///< hex digest of the source file's bytes
  std::string options_digest;  ///< hex digest of the options the map was built with
};

/// The known map: features in the map frame and, where a grid or scans back it, the dense field.
/// Immutable after construction and safe to share between threads.
class FeatureMap
{
 public:
  FeatureMap() = default;

  /// Throws std::invalid_argument for a feature with a non-finite number or a covariance that is
  /// not positive semi-definite.
  explicit FeatureMap(std::vector<Feature> features, std::optional<DenseField> field = std::nullopt,
                      MapErrorModel error = {}, MapProvenance provenance = {});

  const std::vector<Feature>& features() const { return features_; }
  const std::vector<WallLine>& lines() const { return lines_; }
  /// For feature k: index into lines(), or -1 when it is not a segment.
  std::int32_t lineOf(std::size_t k) const { return line_of_[k]; }
  const std::optional<DenseField>& field() const { return field_; }
  const MapErrorModel& error() const { return error_; }
  const MapProvenance& provenance() const { return provenance_; }
  bool empty() const { return features_.empty(); }
  /// Area where the robot can be [m^2]: the field's free area, else the bounding box of the
  /// features.
  double area() const;

 private:
  std::vector<Feature> features_;
  std::vector<WallLine> lines_;
  std::vector<std::int32_t> line_of_;
  std::optional<DenseField> field_;
  MapErrorModel error_;
  MapProvenance provenance_;
};
}  // namespace sigloc
