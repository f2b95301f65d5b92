// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <vector>

#include "eval/worlds/Random.h"
#include "eval/worlds/World.h"
#include "sigloc/config/option_fields.h"
#include "sigloc/features/Feature.h"

namespace sigloc
{
/// A sensor that sees point landmarks around the robot; the defaults are the standard world of the
/// growth study.
struct LandmarkSensorOptions
{
  double range = 8;
  double sigma = 0.05;
  double map_sigma = 0.02;
  double seen_share = 1;
  double spurious_share = 0.3;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = LandmarkSensorOptions;
    visit(OptionField{"range", &O::range, 0.1, 1000.0, "[m] landmarks within are seen"});
    visit(OptionField{"sigma", &O::sigma, 1e-6, 10.0,
                      "[m] standard deviation of an observed place along each axis"});
    visit(OptionField{"map_sigma", &O::map_sigma, 1e-6, 10.0,
                      "[m] standard deviation of a mapped place along each axis"});
    visit(OptionField{"seen_share", &O::seen_share, 0.0, 1.0,
                      "[-] of the landmarks within range; thins n at fixed range and density"});
    visit(OptionField{"spurious_share", &O::spurious_share, 0.0, 0.95,
                      "[-] of all observations that are of nothing mapped"});
  }
};

/// The features that the sensor observes from one pose.
struct LandmarkObservation
{
  std::vector<Feature> features;  ///< points in the robot frame, in random order
  std::vector<std::int32_t> sources;  ///< index into World::points, -1 for a spurious one
};

/// Observes the point landmarks of a world. They are kept in a grid of cells, so the cost of an
/// observation depends on the landmarks within range, not on the size of the world. Const and
/// thread-safe.
class LandmarkSimulator
{
 public:
  /// Throws std::invalid_argument for options out of range.
  explicit LandmarkSimulator(const World& world, const LandmarkSensorOptions& options = {});

  LandmarkObservation observe(const mrpt::math::TPose2D& world_from_robot, Random& random) const;

  /// Returns the map of the landmarks, as many as points and in their order, with the map's noise.
  std::vector<Feature> mappedLandmarks(Random& random) const;

  const LandmarkSensorOptions& options() const { return options_; }

 private:
  std::size_t cellOf(const mrpt::math::TPoint2D& p) const;

  LandmarkSensorOptions options_;
  Bounds bounds_;
  std::vector<mrpt::math::TPoint2D> points_;
  double cell_size_ = 1;
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
  std::vector<std::uint32_t> cell_starts_;
  std::vector<std::uint32_t> cell_points_;
};
}  // namespace sigloc
