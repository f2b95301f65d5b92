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
/// A line with one or more mapped segments that face the same way: fragments of one wall.
struct WallLine
{
  double direction = 0;  ///< [rad], normal into the free space
  double distance = 0;  ///< [m], n . p = distance
  std::vector<std::uint32_t> members;  ///< indices of segments, by position along the tangent
};

/// Links collinear fragments that face the same way into walls. Openings up to 4 m do not separate
/// them. Lines are in the frame of the features, that of the longest fragment first.
/// \cite algorithm section 2, "From scans to a map"
std::vector<WallLine> linkWalls(const std::vector<Feature>& features);

/// The source of a map, stored so that a `.sigmap` is rebuilt only when its source has changed.
struct MapProvenance
{
  std::string source_path;  ///< the file's name, without its folder
  std::string source_checksum;  ///< hex digest of the source file's bytes
  std::string options_digest;  ///< hex digest of the options the map was built with
};

/// The known map: features in the map frame and, where it was made from a grid or from scans, the
/// dense field. Immutable after construction and safe to share between threads.
class FeatureMap
{
 public:
  FeatureMap() = default;

  /// Throws std::invalid_argument with the reason for values that no map has. These are a number
  /// that is not finite, a size or variance out of range, or a covariance that is not positive
  /// semi-definite. So are a parent that is no feature, a place beyond 100 km, and a field that
  /// contradicts its frame.
  explicit FeatureMap(std::vector<Feature> features, std::optional<DenseField> field = std::nullopt,
                      MapErrorModel error = {}, MapProvenance provenance = {});

  /// Returns the same map with another source. A map may be large, so it is not copied.
  FeatureMap madeOf(MapProvenance provenance) &&;

  const std::vector<Feature>& features() const { return features_; }
  const std::vector<WallLine>& lines() const { return lines_; }
  /// Returns the index into lines() of feature k, or -1 when it is not a segment.
  std::int32_t lineOf(std::size_t k) const { return line_of_[k]; }
  const std::optional<DenseField>& field() const { return field_; }
  const MapErrorModel& error() const { return error_; }
  const MapProvenance& provenance() const { return provenance_; }
  bool empty() const { return features_.empty(); }
  /// Returns the area [m^2] in which the robot can be: the field's free area, else the bounding box
  /// of the features.
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
