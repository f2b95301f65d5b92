// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <vector>

#include "eval/worlds/Random.h"
#include "eval/worlds/World.h"
#include "sigloc/config/option_fields.h"
#include "sigloc/features/LaserScan.h"

namespace sigloc
{
/// A laser scanner and its errors.
struct LaserOptions
{
  std::uint32_t beams = 361;
  double fov_deg = 270;
  double max_range = 20;
  double range_sigma = 0.02;
  double range_step = 0;
  double clutter_share = 0;
  double sensor_x = 0;
  double sensor_y = 0;
  double sensor_phi_deg = 0;
  double height = 0.3;
  double pitch_deg = 0;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = LaserOptions;
    visit(OptionField{"beams", &O::beams, 2U, 100000U, "[-] in a scan"});
    visit(OptionField{"fov_deg", &O::fov_deg, 1.0, 360.0,
                      "[deg] field of view; a full circle does not repeat its first beam"});
    visit(OptionField{"max_range", &O::max_range, 0.1, 10000.0,
                      "[m] surfaces farther away give no return"});
    visit(
        OptionField{"range_sigma", &O::range_sigma, 0.0, 1.0, "[m] standard deviation of a range"});
    visit(OptionField{"range_step", &O::range_step, 0.0, 0.1,
                      "[m] ranges are rounded to multiples of this, 0: not rounded"});
    visit(OptionField{"clutter_share", &O::clutter_share, 0.0, 1.0,
                      "[-] share of the beams that end on something nearer"});
    visit(OptionField{"sensor_x", &O::sensor_x, -10.0, 10.0, "[m] mounting place"});
    visit(OptionField{"sensor_y", &O::sensor_y, -10.0, 10.0, "[m] mounting place"});
    visit(OptionField{"sensor_phi_deg", &O::sensor_phi_deg, -360.0, 360.0,
                      "[deg] mounting direction"});
    visit(OptionField{"sensor_z", &O::height, 0.01, 10.0, "[m] above the floor"});
    visit(OptionField{"pitch_deg", &O::pitch_deg, -30.0, 30.0,
                      "[deg] how far the robot's nose is down: beams end on the floor"});
  }
};

/// Casts exact rays against the surfaces of a world.
///
/// The surfaces are hashed into a uniform grid of cells. A ray visits the cells along it in order
/// and stops at the first hit. Construction costs one pass over the surfaces. Casting is const and
/// thread-safe.
class WorldRayCaster
{
 public:
  explicit WorldRayCaster(const World& world);

  /// Returns the distance [m] from `origin` along the direction `angle` [rad] to the nearest
  /// surface, or +infinity when there is none within `max_range` [m].
  double cast(const mrpt::math::TPoint2D& origin, double angle, double max_range) const;

 private:
  void buildCells();
  template <class Visit>
  void forEachCellOf(std::size_t surface, Visit&& visit) const;
  double nearestInCell(std::size_t cell, const mrpt::math::TPoint2D& origin,
                       const mrpt::math::TPoint2D& direction) const;

  std::vector<WallSegment> segments_;
  std::vector<Disc> discs_;
  mrpt::math::TPoint2D grid_origin_;
  double cell_size_ = 1;
  std::int64_t columns_ = 0;
  std::int64_t rows_ = 0;
  std::vector<std::uint32_t> cell_starts_;  ///< into cell_surfaces_, one more than cells
  std::vector<std::uint32_t> cell_surfaces_;  ///< segments first, then discs
};

/// A laser scanner in a world: exact ranges, then noise and clutter.
class LaserSimulator
{
 public:
  /// Throws std::invalid_argument for options out of range.
  explicit LaserSimulator(const World& world, const LaserOptions& options = {});

  /// Returns the scan taken by a robot at a pose, without noise or clutter. Surfaces are so high
  /// that every beam of a tilted robot meets them.
  LaserScan exactScan(const mrpt::math::TPose2D& world_from_robot) const;

  /// Returns the scan with noise and clutter. With probability clutter_share a beam is replaced by
  /// a range uniform between 0.1 m and the true one (max_range where nothing is hit). The other
  /// beams carry Gaussian noise.
  LaserScan scan(const mrpt::math::TPose2D& world_from_robot, Random& random) const;

  const LaserOptions& options() const { return options_; }

 private:
  WorldRayCaster caster_;
  LaserOptions options_;
};
}  // namespace sigloc
