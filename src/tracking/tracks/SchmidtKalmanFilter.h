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
/// Keeps a pose filter honest in a map whose features have errors of their own.
///
/// A mapped feature is wrong by the same error at every addScan. A filter that took it for fresh
/// noise would believe to know the pose ever better from ever the same features. This is the Kalman
/// filter of Schmidt ("consider" filter): it carries, beside the pose, how the pose's error hangs
/// together with the error of each feature it was lately updated with, and leaves the map itself
/// alone. \cite algorithm eq. (8.12), (8.13)
///
/// An update costs O(features remembered), which are those seen on the last stretch.
class SchmidtKalmanFilter
{
 public:
  /// Follows the pose from `map_from_previous` by an odometry increment.
  void predict(const mrpt::math::TPose2D& map_from_previous, const mrpt::math::TPose2D& increment);

  /// Returns the covariance of the measurement's residual at the estimate. `map_noise` is the share
  /// of the measurement's noise that is mapped feature `feature`'s own, see `mapNoise`.
  Symmetric2 innovation(const PoseEstimate& estimate, const PlanarMeasurement& m,
                        std::uint32_t feature, const Symmetric2& map_noise) const;

  /// Updates the estimate by a measurement of a mapped feature; `travelled` [m] is remembered as
  /// when it was last seen.
  void update(PoseEstimate& estimate, const PlanarMeasurement& m, std::uint32_t feature,
              const Symmetric2& map_noise, double travelled);

  /// Updates the estimate by a measurement whose noise is all drawn anew at each addScan.
  void updateFreely(PoseEstimate& estimate, const PlanarMeasurement& m);

  /// True when the pose was updated with the feature and has not forgotten it since.
  bool knows(std::uint32_t feature) const { return find(feature) != nullptr; }

  /// Forgets what was last seen before `travelled` [m].
  void forgetBefore(double travelled);

  std::size_t size() const { return known_.size(); }

 private:
  using Cross = std::array<std::array<double, 2>, 3>;  // a row for each of (x, y, heading)
  struct Known
  {
    std::uint32_t feature;
    Symmetric2 noise;  // of the feature, as it was at the first sight
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
