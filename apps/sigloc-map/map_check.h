// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "sigloc/map/FeatureMap.h"
#include "sigloc/map/sensor_model.h"
#include "twins.h"

namespace sigloc
{
/// How much a check asks.
struct CheckOptions
{
  std::uint32_t places = 500;  ///< spread over the free space
  std::uint32_t scans = 6;  ///< at each place, at any heading
  std::uint32_t drives = 40;  ///< from places where one scan is not enough
  std::uint32_t seed = 1;
  /// Ask at these poses, and not over the free space.
  std::vector<mrpt::math::TPose2D> poses;
};

/// What the scans simulated at one place gave.
struct CheckedPlace
{
  mrpt::math::TPose2D pose;  ///< the heading counts where poses were given
  std::uint32_t scans = 0;
  std::uint32_t right = 0;  ///< the first candidate is within 0.5 m and 10 degrees
  std::uint32_t localized = 0;
  std::uint32_t fooled = 0;  ///< localized, and not right
  double probability = 0;  ///< mean of the right candidate's
  std::optional<double> drive;  ///< [m] until localized; infinite: not on a drive of kDrive

  double localizedShare() const { return static_cast<double>(localized) / scans; }
  /// Whether most scans localize.
  bool oneScanIsEnough() const { return 2 * localized > scans; }
};

/// The answer to "will it work in this map?"
struct MapCheck
{
  static constexpr double kDrive = 20;  ///< [m], the longest drive
  SimulatedLaserOptions laser;  ///< that took the scans
  double area = 0;  ///< [m^2] in which the robot can be: the largest part that it reaches
  double free_area = 0;  ///< [m^2] of the whole map
  std::vector<CheckedPlace> places;
  std::vector<Twins> twins;
  std::vector<double> times_ms;  ///< CPU time of each scan, from ranges to candidates

  double recall() const;
  double localizedShare() const;
  double fooledShare() const;
  /// Share of the places at which one scan is enough.
  double enoughShare() const;
  /// [m], in order; infinite ones are drives that ended unsure.
  std::vector<double> drives() const;
};

/// Asks sigloc for the poses of scans simulated in a map with a dense field. Depends only on map,
/// laser and options, times aside. Throws std::invalid_argument for a map without a field or free
/// space.
MapCheck checkMap(const std::shared_ptr<const FeatureMap>& map, const SimulatedLaserOptions& laser,
                  const CheckOptions& options,
                  const std::function<void(double share)>& progress = {});
}  // namespace sigloc
