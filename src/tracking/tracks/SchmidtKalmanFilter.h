// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/PoseEstimate.h"

namespace sigloc
{
/// The Kalman filter of Schmidt (1966), the "consider" filter, for a map whose features have errors
/// of their own.
///
/// A mapped feature is wrong by the same error in every scan. A filter that took it for fresh noise
/// would become too sure of the pose. This one also carries the covariance between the pose's error
/// and the error of each feature that has lately updated it. It leaves the map itself alone.
/// \cite algorithm eq. (8.12), (8.13)
///
/// An update costs O(features remembered): those seen within the last 10 m of travel.
class SchmidtKalmanFilter
{
 public:
  using Cross = std::array<std::array<double, 2>, 3>;  ///< a row for each of (x, y, heading)

  /// Moves the covariances with the pose, from `map_from_previous` by an odometry increment.
  /// Eq. (8.12)
  void predict(const mrpt::math::TPose2D& map_from_previous, const mrpt::math::TPose2D& increment);

  /// Returns the covariance of the measurement's residual at the estimate: S of eq. (8.13).
  /// `map_noise` is the part of the measurement's noise that mapped feature `feature` has itself,
  /// see `mapNoise`.
  Symmetric2 innovation(const PoseEstimate& estimate, const PlanarMeasurement& m,
                        std::uint32_t feature, const Symmetric2& map_noise) const;

  /// Updates the estimate by a measurement of a mapped feature, which was last seen after
  /// `travelled` [m]. Eq. (8.13)
  void update(PoseEstimate& estimate, const PlanarMeasurement& m, std::uint32_t feature,
              const Symmetric2& map_noise, double travelled);

  /// Updates the estimate by a measurement whose noise is independent in each scan.
  void updateFreely(PoseEstimate& estimate, const PlanarMeasurement& m);

  /// True when the feature has updated the pose and has not been forgotten since.
  bool knows(std::uint32_t feature) const { return find(feature) != nullptr; }

  /// Forgets the features last seen before `travelled` [m].
  void forgetBefore(double travelled);

  std::size_t size() const { return known_.size(); }

 private:
  struct Known
  {
    std::uint32_t feature;
    Symmetric2 noise;  // of the feature, as at its first measurement
    Cross cross{};  // E[pose error, feature error']
    double last_seen;
  };
  const Known* find(std::uint32_t feature) const;
  Symmetric2 innovation(const PoseEstimate& estimate, const PlanarMeasurement& m,
                        const Known* known, const Symmetric2& map_noise) const;
  void apply(PoseEstimate& estimate, const PlanarMeasurement& m, const Cross& gain,
             const Symmetric2& innovation);

  std::vector<Known> known_;
};
}  // namespace sigloc
