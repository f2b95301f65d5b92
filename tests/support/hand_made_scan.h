// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "sigloc/features/LaserScan.h"

namespace sigloc::test
{
/// Surfaces of a scene drawn by hand, in metres.
struct Surfaces
{
  struct Wall
  {
    mrpt::math::TPoint2D from, to;
  };
  struct Pillar
  {
    mrpt::math::TPoint2D centre;
    double radius;
  };
  std::vector<Wall> walls;
  std::vector<Pillar> pillars;
};

/// A closed outline through the given vertices.
inline Surfaces outline(const std::vector<mrpt::math::TPoint2D>& vertices)
{
  Surfaces surfaces;
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    surfaces.walls.push_back({vertices[i], vertices[(i + 1) % vertices.size()]});
  }
  return surfaces;
}

/// Distance along a ray to the nearest surface, by trying them all; infinite when there is none.
inline double castByHand(const Surfaces& surfaces, const mrpt::math::TPoint2D& origin, double angle)
{
  const double dx = std::cos(angle);
  const double dy = std::sin(angle);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Surfaces::Wall& wall : surfaces.walls)
  {
    const auto side = wall.to - wall.from;
    const auto start = wall.from - origin;
    const double determinant = dx * side.y - dy * side.x;
    if (std::abs(determinant) < 1e-12) continue;
    const double along = (start.x * side.y - start.y * side.x) / determinant;
    const double share = (start.x * dy - start.y * dx) / determinant;
    if (along > 0 && share >= 0 && share <= 1) nearest = std::min(nearest, along);
  }
  for (const Surfaces::Pillar& pillar : surfaces.pillars)
  {
    const auto start = pillar.centre - origin;
    const double along = start.x * dx + start.y * dy;
    const double off2 = start.x * start.x + start.y * start.y - along * along;
    const double half2 = pillar.radius * pillar.radius - off2;
    if (half2 >= 0 && along > pillar.radius) nearest = std::min(nearest, along - std::sqrt(half2));
  }
  return nearest;
}

struct Scanner
{
  std::size_t beams = 361;
  double field_of_view = 2 * M_PI;  ///< [rad]; a full circle doesn't repeat its first beam
  double first_angle = -M_PI;  ///< [rad]
  double sigma = 0;  ///< [m]
  double max_range = LaserScan{}.max_range;  ///< [m]
  mrpt::math::TPose2D robot_from_sensor;
};

/// The scan of a robot at a pose; beams that meet nothing are invalid.
inline LaserScan scanByHand(const Surfaces& surfaces, const mrpt::math::TPose2D& world_from_robot,
                            const Scanner& scanner = {}, std::mt19937_64* random = nullptr)
{
  LaserScan scan;
  const bool full = scanner.field_of_view > 2 * M_PI - 1e-9;
  scan.first_angle = scanner.first_angle;
  scan.angle_step =
      scanner.field_of_view / static_cast<double>(full ? scanner.beams : scanner.beams - 1);
  scan.robot_from_sensor = scanner.robot_from_sensor;
  scan.range_sigma = scanner.sigma;
  scan.max_range = scanner.max_range;
  const mrpt::math::TPose2D world_from_sensor = world_from_robot + scanner.robot_from_sensor;
  std::normal_distribution<double> noise(0.0, 1.0);
  for (std::size_t i = 0; i < scanner.beams; ++i)
  {
    const double angle =
        world_from_sensor.phi + scan.first_angle + static_cast<double>(i) * scan.angle_step;
    double range = castByHand(surfaces, {world_from_sensor.x, world_from_sensor.y}, angle);
    if (random != nullptr) range += scanner.sigma * noise(*random);
    const bool hit = std::isfinite(range) && range > 0 && range < scan.max_range;
    scan.ranges.push_back(hit ? static_cast<float>(range) : 0.0F);
    scan.valid.push_back(hit ? 1 : 0);
  }
  return scan;
}
}  // namespace sigloc::test
