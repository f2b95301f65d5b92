// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/ExplainedConstraints.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "matching/dense/CellView.h"
#include "matching/dense/likelihood_table.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kSampleStep = 0.1;  // [m] along an observed wall
constexpr double kExplained = 0.5;  // fine likelihood from which the map explains a feature
constexpr double kSameDirection = 0.2;  // [rad] between two pieces of one wall
constexpr double kSameOffset = 0.2;  // [m] between two pieces of one wall
constexpr double kBend = 0.6;  // [rad] from one piece of a curved wall to the next
constexpr double kJoint = 0.3;  // [m] between the ends of two pieces of a curved wall
constexpr std::uint32_t kCurveConstraints = 3;  // of a curved wall: a centre and a radius
constexpr double kInside = 0.1;  // [m] before a wall end, where a wall must be mapped
constexpr double kBeyond = 0.3;  // [m] beyond a wall end, where no wall may be mapped
constexpr double kOnWall = 0.13;  // [m] from a mapped wall, within which a point is on it
constexpr double kOffWall = 0.16;  // [m] from any mapped wall, beyond which a point is off walls
}  // namespace

/// What the map says about an observed wall.
enum class ExplainedConstraints::WallState : std::uint8_t
{
  mapped,
  missing,
  unknown,  // most of it lies in unknown area
};

/// Look-up of points given in the robot frame.
class ExplainedConstraints::PlacedField
{
 public:
  PlacedField(const DenseField& field, const TPose2D& pose) : cells_(field), place_(pose) {}

  WallState stateOf(const Wall& wall) const
  {
    const TPoint2D along = wall.end - wall.start;
    const int samples = std::max(2, static_cast<int>(std::lround(wall.length / kSampleStep)));
    double likelihood = 0;
    int unknown = 0;
    for (int i = 0; i < samples; ++i)
    {
      const DenseCell& cell = cellAt(wall.start + along * ((i + 0.5) / samples));
      likelihood += static_cast<double>(fineTable()[cell.distance]);
      unknown += cell.state == CellState::unknown;
    }
    if (likelihood > kExplained * samples) return WallState::mapped;
    return 2 * unknown > samples ? WallState::unknown : WallState::missing;
  }
  double distance(const TPoint2D& p) const
  {
    return cellAt(p).distance * DenseField::kDistanceUnit;
  }

 private:
  const DenseCell& cellAt(const TPoint2D& p) const
  {
    const auto x = static_cast<float>(p.x);
    const auto y = static_cast<float>(p.y);
    return cells_.at(place_.placedX(x, y), place_.placedY(x, y));
  }

  CellView cells_;
  Placement place_;
};

/// Counts walls: the pieces of one wall once, those of a curved wall kCurveConstraints at most.
class ExplainedConstraints::WallCount
{
 public:
  /// Adds a wall. Returns whether it is a further constraint, besides those of the walls before.
  bool add(const Wall& wall)
  {
    const auto is_known = [&](const Counted& other) { return isSameWall(wall, *other.wall); };
    if (std::any_of(walls_.begin(), walls_.end(), is_known)) return false;
    const auto before =
        std::find_if(walls_.begin(), walls_.end(),
                     [&](const Counted& other) { return bendsOn(*other.wall, wall); });
    const std::size_t curve = before != walls_.end() ? before->curve : count_of_curve_.size();
    if (curve == count_of_curve_.size()) count_of_curve_.push_back(0);
    walls_.push_back({&wall, curve});
    return ++count_of_curve_[curve] <= kCurveConstraints;
  }

 private:
  struct Counted
  {
    const Wall* wall;
    std::size_t curve;
  };
  std::vector<Counted> walls_;
  std::vector<std::uint32_t> count_of_curve_;
};

ExplainedConstraints::ExplainedConstraints(const std::vector<Feature>& observed)
{
  for (const Feature& feature : observed)
  {
    const TPoint2D along = directionVector(feature);
    const TPoint2D& place = feature.position;
    if (isSegment(feature.type))
    {
      const TPoint2D half = TPoint2D(along.y, -along.x) * (0.5 * feature.size);
      walls_.push_back({feature.direction, feature.size, place, along, place - half, place + half});
    }
    if (feature.type == FeatureType::wall_end)
    {
      wall_ends_.push_back({place + along * kInside, place - along * kBeyond});
    }
  }
}

bool ExplainedConstraints::isSameWall(const Wall& a, const Wall& b)
{
  const TPoint2D d = a.middle - b.middle;
  return std::abs(b.normal.x * d.x + b.normal.y * d.y) < kSameOffset &&
         std::abs(wrapToPi(a.direction - b.direction)) < kSameDirection;
}

/// True for a piece that continues where another ends and bends less than a corner.
bool ExplainedConstraints::bendsOn(const Wall& a, const Wall& b)
{
  const double joint = std::min((a.end - b.start).norm(), (a.start - b.end).norm());
  return joint < kJoint && std::abs(wrapToPi(a.direction - b.direction)) < kBend;
}

ConstraintCounts ExplainedConstraints::countAt(const TPose2D& pose, const DenseField& field) const
{
  const PlacedField placed(field, pose);
  WallCount walls;
  WallCount missing;
  ConstraintCounts counts;
  for (const Wall& wall : walls_)
  {
    switch (placed.stateOf(wall))
    {
      case WallState::mapped:
        counts.walls += walls.add(wall);
        break;
      case WallState::missing:
        counts.missing_walls += missing.add(wall);
        break;
      case WallState::unknown:
        break;
    }
  }
  for (const WallEnd& end : wall_ends_)
  {
    counts.wall_ends +=
        placed.distance(end.before) < kOnWall && placed.distance(end.beyond) > kOffWall;
  }
  return counts;
}
}  // namespace sigloc
