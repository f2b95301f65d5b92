// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "explained_facts.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "CellView.h"
#include "likelihood_table.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kSampleStep = 0.1;  // [m] along an observed wall
constexpr double kExplained = 0.5;  // mean fine likelihood of what the map explains
constexpr double kSameDirection = 0.2;  // [rad], of two pieces of one wall
constexpr double kSameOffset = 0.2;  // [m]
constexpr double kBend = 0.6;  // [rad], from one piece of a curved wall to the next
constexpr double kJoint = 0.3;  // [m] between their ends
constexpr std::uint32_t kCurveFacts = 3;  // a centre and a radius
constexpr double kInside = 0.1;  // [m] before its end a wall must be mapped,
constexpr double kBeyond = 0.3;  // [m] and beyond it, not
constexpr double kOnWall = 0.13;  // [m], of a place on a mapped wall
constexpr double kOffWall = 0.16;  // [m], of one that is not

/// Look-ups of places given in the robot frame.
class PlacedField
{
 public:
  PlacedField(const DenseField& field, const TPose2D& pose) : cells_(field), place_(pose) {}

  double likelihood(const TPoint2D& p) const
  {
    return static_cast<double>(fineTable()[cellAt(p).distance]);
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

bool wallExplained(const Feature& wall, const PlacedField& field)
{
  const TPoint2D start = segmentStart(wall);
  const TPoint2D along = segmentEnd(wall) - start;
  const int samples = std::max(2, static_cast<int>(std::lround(wall.size / kSampleStep)));
  double sum = 0;
  for (int i = 0; i < samples; ++i) sum += field.likelihood(start + along * ((i + 0.5) / samples));
  return sum > kExplained * samples;
}

bool endExplained(const Feature& end, const PlacedField& field)
{
  const TPoint2D along = directionVector(end);
  return field.distance(end.position + along * kInside) < kOnWall &&
         field.distance(end.position - along * kBeyond) > kOffWall;
}

bool circleExplained(const Feature& circle, const PlacedField& field)
{
  return field.likelihood(circle.position + directionVector(circle) * circle.size) > kExplained;
}

bool sameWall(const Feature& a, const Feature& b)
{
  const TPoint2D normal = directionVector(b);
  const TPoint2D d = a.position - b.position;
  return std::abs(mrpt::math::wrapToPi(a.direction - b.direction)) < kSameDirection &&
         std::abs(normal.x * d.x + normal.y * d.y) < kSameOffset;
}

/// True for a piece that goes on where another ends, and bends less than a corner does.
bool bendsOn(const Feature& a, const Feature& b)
{
  const double bend = std::abs(mrpt::math::wrapToPi(a.direction - b.direction));
  const double joint =
      std::min((segmentEnd(a) - segmentStart(b)).norm(), (segmentStart(a) - segmentEnd(b)).norm());
  return bend < kBend && joint < kJoint;
}

/// Counts walls: pieces of one wall once, the pieces of a curved one as what it is made by.
class WallCount
{
 public:
  /// Adds a wall; returns whether it tells something that those before it did not.
  bool add(const Feature& wall)
  {
    const auto known = [&](const Counted& other) { return sameWall(wall, *other.wall); };
    if (std::any_of(walls_.begin(), walls_.end(), known)) return false;
    const auto before =
        std::find_if(walls_.begin(), walls_.end(),
                     [&](const Counted& other) { return bendsOn(*other.wall, wall); });
    const std::size_t curve = before != walls_.end() ? before->curve : facts_of_curve_.size();
    if (curve == facts_of_curve_.size()) facts_of_curve_.push_back(0);
    walls_.push_back({&wall, curve});
    return ++facts_of_curve_[curve] <= kCurveFacts;
  }

 private:
  struct Counted
  {
    const Feature* wall;
    std::size_t curve;
  };
  std::vector<Counted> walls_;
  std::vector<std::uint32_t> facts_of_curve_;
};
}  // namespace

std::uint32_t explainedFacts(const std::vector<Feature>& observed, const DenseField& field,
                             const TPose2D& pose)
{
  const PlacedField placed(field, pose);
  WallCount walls;
  std::uint32_t facts = 0;
  for (const Feature& feature : observed)
  {
    if (feature.type == FeatureType::segment && wallExplained(feature, placed))
    {
      facts += walls.add(feature);
    }
    if (feature.type == FeatureType::wall_end && endExplained(feature, placed)) ++facts;
    if (feature.type == FeatureType::circle && circleExplained(feature, placed)) facts += 2;
  }
  return facts;
}
}  // namespace sigloc
