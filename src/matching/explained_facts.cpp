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
}  // namespace

std::uint32_t explainedFacts(const std::vector<Feature>& observed, const DenseField& field,
                             const TPose2D& pose)
{
  const PlacedField placed(field, pose);
  std::vector<const Feature*> walls;
  std::uint32_t facts = 0;
  for (const Feature& feature : observed)
  {
    if (feature.type == FeatureType::segment && wallExplained(feature, placed))
    {
      const bool known = std::any_of(walls.begin(), walls.end(),
                                     [&](const Feature* wall) { return sameWall(feature, *wall); });
      if (known) continue;
      walls.push_back(&feature);
      ++facts;
    }
    if (feature.type == FeatureType::wall_end && endExplained(feature, placed)) ++facts;
    if (feature.type == FeatureType::circle && circleExplained(feature, placed)) facts += 2;
  }
  return facts;
}
}  // namespace sigloc
