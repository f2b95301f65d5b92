// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/ExplainedConstraints.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "features/round_walls.h"
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
constexpr double kAtEnd = 0.15;  // [m] from the end of a piece of a round wall to a wall end of it
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
      likelihood += static_cast<double>(fineTable()[cell.distance()]);
      unknown += cell.state() == CellState::unknown;
    }
    if (likelihood > kExplained * samples) return WallState::mapped;
    return 2 * unknown > samples ? WallState::unknown : WallState::missing;
  }
  double distance(const TPoint2D& p) const
  {
    return cellAt(p).distance() * DenseField::kDistanceUnit;
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

/// Counts walls: the pieces of one wall once.
class ExplainedConstraints::WallCount
{
 public:
  void add(const Wall& wall)
  {
    const auto is_known = [&](const Wall* other) { return isSameWall(wall, *other); };
    if (std::none_of(walls_.begin(), walls_.end(), is_known)) walls_.push_back(&wall);
  }
  std::uint32_t count() const { return static_cast<std::uint32_t>(walls_.size()); }

 private:
  std::vector<const Wall*> walls_;
};

ExplainedConstraints::ExplainedConstraints(const std::vector<Feature>& observed)
{
  const std::vector<bool> on_round = onRoundWalls(observed);
  std::vector<TPoint2D> round_ends;
  for (std::size_t k = 0; k < observed.size(); ++k)
  {
    if (!on_round[k]) continue;
    round_ends.push_back(segmentStart(observed[k]));
    round_ends.push_back(segmentEnd(observed[k]));
  }
  const auto ends_round_wall = [&](const Feature& wall_end)
  {
    return std::any_of(round_ends.begin(), round_ends.end(),
                       [&](const TPoint2D& end)
                       { return (end - wall_end.position).norm() < kAtEnd; });
  };
  for (std::size_t k = 0; k < observed.size(); ++k)
  {
    const Feature& feature = observed[k];
    if (isSegment(feature.type) && !on_round[k]) addWall(feature);
    if (feature.type == FeatureType::wall_end && !ends_round_wall(feature)) addWallEnd(feature);
  }
}

void ExplainedConstraints::addWall(const Feature& segment)
{
  walls_.push_back({segment.direction, segment.size, segment.position, directionVector(segment),
                    segmentStart(segment), segmentEnd(segment)});
}

void ExplainedConstraints::addWallEnd(const Feature& wall_end)
{
  const TPoint2D along = directionVector(wall_end);
  wall_ends_.push_back({wall_end.position + along * kInside, wall_end.position - along * kBeyond});
}

bool ExplainedConstraints::isSameWall(const Wall& a, const Wall& b)
{
  const TPoint2D d = a.middle - b.middle;
  return std::abs(b.normal.x * d.x + b.normal.y * d.y) < kSameOffset &&
         std::abs(wrapToPi(a.direction - b.direction)) < kSameDirection;
}

ConstraintCounts ExplainedConstraints::countAt(const TPose2D& pose, const DenseField& field) const
{
  const PlacedField placed(field, pose);
  WallCount walls;
  WallCount missing;
  for (const Wall& wall : walls_)
  {
    switch (placed.stateOf(wall))
    {
      case WallState::mapped:
        walls.add(wall);
        break;
      case WallState::missing:
        missing.add(wall);
        break;
      case WallState::unknown:
        break;
    }
  }
  ConstraintCounts counts;
  counts.walls = walls.count();
  counts.missing_walls = missing.count();
  for (const WallEnd& end : wall_ends_)
  {
    counts.wall_ends +=
        placed.distance(end.before) < kOnWall && placed.distance(end.beyond) > kOffWall;
  }
  return counts;
}
}  // namespace sigloc
