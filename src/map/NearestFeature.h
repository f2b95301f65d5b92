// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "sigloc/features/Feature.h"
#include "sigloc/map/sensor_model.h"

namespace sigloc
{
/// Returns the place on a feature that is nearest to a point: on the segment between its ends, on
/// the full circle, else the feature's position. Both are in the same frame [m].
mrpt::math::TPoint2D nearestPlaceOn(const Feature& feature, const mrpt::math::TPoint2D& point);

/// Finds the feature nearest to a point through a spatial hash. Immutable after construction and
/// safe to share between threads.
class NearestFeature
{
 public:
  struct Hit
  {
    std::uint32_t feature = 0;  ///< index into the features of the constructor
    mrpt::math::TPoint2D place;  ///< [m], on the feature
    double distance = 0;  ///< [m]
  };

  explicit NearestFeature(std::vector<Feature> features);

  /// Returns the nearest feature within `radius` [m], of equally near ones that of lower index. The
  /// cost grows with the square of the radius, up to that of asking each feature.
  std::optional<Hit> find(const mrpt::math::TPoint2D& point, double radius) const;

  const std::vector<Feature>& features() const { return features_; }

 private:
  std::vector<Feature> features_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// The log-likelihood of sensor_model.h, with the distance to the nearest feature.
double logLikelihood(const NearestFeature& nearest, const std::vector<mrpt::math::TPoint2D>& points,
                     const mrpt::math::TPose2D& map_from_robot,
                     const PointLikelihoodOptions& options = {});
}  // namespace sigloc
