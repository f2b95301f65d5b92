// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <vector>

#include "sigloc/features/Feature.h"
#include "sigloc/map/DenseField.h"
#include "sigloc/matching/RelocationResult.h"

namespace sigloc
{
/// The constraints on a pose that the features of a scene give, prepared for many poses.
/// \cite algorithm eq. (7.5)
class ExplainedConstraints
{
 public:
  explicit ExplainedConstraints(const std::vector<Feature>& observed);

  /// Counts the constraints when the robot is at `pose`. A wall counts one, however many pieces of
  /// it are seen. Round walls and their ends do not count.
  ConstraintCounts countAt(const mrpt::math::TPose2D& pose, const DenseField& field) const;

 private:
  /// All points are in the robot frame [m].
  struct Wall
  {
    double direction;  // [rad], of the normal
    double length;  // [m]
    mrpt::math::TPoint2D middle, normal, start, end;
  };
  struct WallEnd
  {
    mrpt::math::TPoint2D before, beyond;  // points before and beyond the end of the wall
  };
  enum class WallState : std::uint8_t;
  class WallCount;
  class PlacedField;

  static bool isSameWall(const Wall& a, const Wall& b);
  void addWall(const Feature& segment);
  void addWallEnd(const Feature& wall_end);

  std::vector<Wall> walls_;
  std::vector<WallEnd> wall_ends_;
};
}  // namespace sigloc
