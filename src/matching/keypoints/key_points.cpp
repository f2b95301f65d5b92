// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include "geometry/cell_key.h"
#include "matching/keypoints/KeyPoint.h"
#include "signature/DirectedFeature.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kCrossingSine = 0.5;  // least |sin| of the angle between two lines that cross
constexpr double kShortest = 0.4;  // [m] of a piece of wall whose line may cross others
constexpr double kObservedReach = 3.0;  // [m] beyond an observed piece
constexpr double kMappedReach = 1.0;  // [m] beyond a linked wall
constexpr double kMergeDistance = 0.12;  // [m] within which two key points are the same
constexpr double kMergeAngle = 0.1;  // [rad] between their directions
constexpr double kMaxPositionVariance = 0.15 * 0.15;  // [m^2] of a key point that tells something
constexpr double kMaxDirectionVariance = 0.1 * 0.1;  // [rad^2]
constexpr double kStraightness = 0.008;  // [m] by which a piece of wall is off a straight line
constexpr double kWallCell = 4.0;  // [m] of the hash over walls

/// Returns the variance of a wall's direction [rad^2]. A piece of wall is no perfect line, so its
/// direction is off by more than its returns' noise, the more the shorter it is. Eq. (4.11)
double directionVariance(const Feature& feature)
{
  const double length = std::max(feature.size, kShortest);
  return feature.direction_variance + 12 * kStraightness * kStraightness / (length * length);
}

/// A piece of wall with its line.
struct WallPiece
{
  const Feature* segment = nullptr;
  double direction_variance = 0;  // [rad^2]
  TPoint2D normal, tangent;
  double half = 0;  // [m] of its length
};

WallPiece pieceOf(const Feature& segment)
{
  const TPoint2D normal = directionVector(segment);
  return {&segment, directionVariance(segment), normal, {normal.y, -normal.x}, 0.5 * segment.size};
}

/// Returns where the lines of two pieces cross, if they do at a telling angle.
std::optional<TPoint2D> crossingOf(const WallPiece& a, const WallPiece& b)
{
  const double sine = cross(a.normal, b.normal);
  if (std::abs(sine) < kCrossingSine) return std::nullopt;
  const TPoint2D between = b.segment->position - a.segment->position;
  return a.segment->position + a.tangent * (dot(between, b.normal) / dot(a.tangent, b.normal));
}

/// Returns how far a point of the line lies beyond the ends of the piece [m], or 0 on the piece.
double beyond(const WallPiece& piece, const TPoint2D& point)
{
  const double along = dot(point - piece.segment->position, piece.tangent);
  return std::max(0.0, std::abs(along) - piece.half);
}

/// Returns the key point where two lines cross. The offset error of each line, and its angle error
/// over the lever from the middle of the piece, move the point along the other line.
KeyPoint crossingPoint(const WallPiece& a, const WallPiece& b, const TPoint2D& at)
{
  const auto offset_variance = [&](const WallPiece& piece)
  {
    const double lever = dot(at - piece.segment->position, piece.tangent);
    return varianceAlong(*piece.segment, piece.normal) + lever * lever * piece.direction_variance;
  };
  const double sine = cross(a.normal, b.normal);
  const double of_a = offset_variance(a) / (sine * sine);
  const double of_b = offset_variance(b) / (sine * sine);
  KeyPoint point;
  point.kind = KeyPointKind::crossing;
  point.position = at;
  point.covariance = {of_a * b.tangent.x * b.tangent.x + of_b * a.tangent.x * a.tangent.x,
                      of_a * b.tangent.x * b.tangent.y + of_b * a.tangent.x * a.tangent.y,
                      of_a * b.tangent.y * b.tangent.y + of_b * a.tangent.y * a.tangent.y};
  const double turn = wrapToPi(b.segment->direction - a.segment->direction);
  point.direction = wrapToPi(a.segment->direction + 0.5 * turn);
  point.direction_variance = 0.25 * (a.direction_variance + b.direction_variance);
  return point;
}

KeyPoint placeOf(const Feature& feature)
{
  KeyPoint point;
  point.position = feature.position;
  const auto& p = feature.position_covariance;
  point.covariance = {p(0, 0), p(0, 1), p(1, 1)};
  if (feature.type == FeatureType::circle)
  {
    point.kind = KeyPointKind::circle;
    point.radius = feature.size;
    point.radius_variance = feature.size_variance;
    return point;
  }
  point.kind = feature.side == WallSide::start ? KeyPointKind::wall_start : KeyPointKind::wall_end;
  point.direction = feature.direction;
  point.direction_variance = directionVariance(feature);
  return point;
}

bool isPlace(const Feature& feature)
{
  return feature.type == FeatureType::wall_end || feature.type == FeatureType::circle;
}

double spread(const KeyPoint& point)
{
  return point.covariance.xx + point.covariance.yy;
}

bool isTelling(const KeyPoint& point)
{
  return spread(point) <= kMaxPositionVariance && point.direction_variance <= kMaxDirectionVariance;
}

/// Removes what is too uncertain and what repeats a more certain key point.
std::vector<KeyPoint> distinct(std::vector<KeyPoint> points)
{
  points.erase(std::remove_if(points.begin(), points.end(),
                              [](const KeyPoint& point) { return !isTelling(point); }),
               points.end());
  std::stable_sort(points.begin(), points.end(),
                   [](const KeyPoint& a, const KeyPoint& b) { return spread(a) < spread(b); });
  const auto same = [](const KeyPoint& a, const KeyPoint& b)
  {
    const TPoint2D between = a.position - b.position;
    return a.kind == b.kind && dot(between, between) < kMergeDistance * kMergeDistance &&
           std::abs(wrapToPi(a.direction - b.direction)) < kMergeAngle;
  };
  std::vector<KeyPoint> kept;
  kept.reserve(points.size());
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells;
  for (const KeyPoint& point : points)
  {
    const auto x = static_cast<std::int64_t>(std::floor(point.position.x / kMergeDistance));
    const auto y = static_cast<std::int64_t>(std::floor(point.position.y / kMergeDistance));
    bool repeats = false;
    for (std::int64_t k = 0; k < 9 && !repeats; ++k)
    {
      const auto cell = cells.find(cellKey(x + k % 3 - 1, y + k / 3 - 1));
      if (cell == cells.end()) continue;
      repeats = std::any_of(cell->second.begin(), cell->second.end(),
                            [&](std::uint32_t other) { return same(point, kept[other]); });
    }
    if (repeats) continue;
    cells[cellKey(x, y)].push_back(static_cast<std::uint32_t>(kept.size()));
    kept.push_back(point);
  }
  return kept;
}

/// A linked wall: the stretch that its fragments cover, and the fragments with a line.
struct LinkedWall
{
  WallPiece longest;
  double low = 0, high = 0;  // [m] along the tangent from the middle of the longest
  std::vector<WallPiece> pieces;

  double beyond(const TPoint2D& point) const
  {
    const double along = dot(point - longest.segment->position, longest.tangent);
    return std::max({0.0, low - along, along - high});
  }
  /// Returns the piece whose line holds best near a point of the wall.
  const WallPiece& nearest(const TPoint2D& point) const
  {
    return *std::min_element(pieces.begin(), pieces.end(),
                             [&](const WallPiece& a, const WallPiece& b)
                             { return sigloc::beyond(a, point) < sigloc::beyond(b, point); });
  }
};

std::vector<LinkedWall> linkedWalls(const FeatureMap& map)
{
  std::vector<LinkedWall> walls;
  walls.reserve(map.lines().size());
  for (const WallLine& line : map.lines())
  {
    LinkedWall wall;
    for (const std::uint32_t k : line.members)
    {
      const Feature& segment = map.features()[k];
      if (segment.size < kShortest) continue;
      wall.pieces.push_back(pieceOf(segment));
      if (!wall.longest.segment || segment.size > wall.longest.segment->size)
      {
        wall.longest = wall.pieces.back();
      }
    }
    if (wall.pieces.empty()) continue;
    wall.low = -wall.longest.half;
    wall.high = wall.longest.half;
    for (const std::uint32_t k : line.members)
    {
      const Feature& segment = map.features()[k];
      const auto along = [&](const TPoint2D& p)
      { return dot(p - wall.longest.segment->position, wall.longest.tangent); };
      wall.low = std::min(wall.low, along(segmentStart(segment)));
      wall.high = std::max(wall.high, along(segmentEnd(segment)));
    }
    walls.push_back(std::move(wall));
  }
  return walls;
}

/// A hash of cells with the walls that pass or nearly pass through each.
using WallCells = std::unordered_map<std::uint64_t, std::vector<std::uint32_t>>;

std::uint64_t cellOf(const TPoint2D& point)
{
  return cellKey(static_cast<std::int64_t>(std::floor(point.x / kWallCell)),
                 static_cast<std::int64_t>(std::floor(point.y / kWallCell)));
}

void enterWall(const LinkedWall& wall, std::uint32_t index, WallCells& cells)
{
  // No point of the prolonged wall is farther than this from the nearest step along either axis.
  constexpr double kMargin = 0.26 * kWallCell;
  const double low = wall.low - kMappedReach;
  const double length = wall.high + kMappedReach - low;
  const int steps = static_cast<int>(std::ceil(2 * length / kWallCell));
  for (int k = 0; k <= steps; ++k)
  {
    const TPoint2D at = wall.longest.segment->position +
                        wall.longest.tangent * (low + length * k / std::max(1, steps));
    for (const double dx : {-kMargin, kMargin})
    {
      for (const double dy : {-kMargin, kMargin})
      {
        auto& cell = cells[cellOf({at.x + dx, at.y + dy})];
        if (cell.empty() || cell.back() != index) cell.push_back(index);
      }
    }
  }
}

void appendMappedCrossings(const FeatureMap& map, std::vector<KeyPoint>& points)
{
  const std::vector<LinkedWall> walls = linkedWalls(map);
  WallCells cells;
  for (std::uint32_t w = 0; w < walls.size(); ++w) enterWall(walls[w], w, cells);
  // A crossing is looked for in its own cell only, so no pair of walls counts twice.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (const auto& [key, members] : cells)
  {
    for (std::size_t i = 0; i < members.size(); ++i)
    {
      for (std::size_t j = i + 1; j < members.size(); ++j)
      {
        const auto at = crossingOf(walls[members[i]].longest, walls[members[j]].longest);
        if (!at || cellOf(*at) != key) continue;
        if (walls[members[i]].beyond(*at) > kMappedReach) continue;
        if (walls[members[j]].beyond(*at) > kMappedReach) continue;
        found.emplace_back(members[i], members[j]);
      }
    }
  }
  std::sort(found.begin(), found.end());
  for (const auto& [i, j] : found)
  {
    const TPoint2D roughly = *crossingOf(walls[i].longest, walls[j].longest);
    const WallPiece& a = walls[i].nearest(roughly);
    const WallPiece& b = walls[j].nearest(roughly);
    if (const auto at = crossingOf(a, b)) points.push_back(crossingPoint(a, b, *at));
  }
}
}  // namespace

std::vector<KeyPoint> observedKeyPoints(const std::vector<Feature>& features)
{
  std::vector<KeyPoint> points;
  std::vector<WallPiece> pieces;
  for (const Feature& feature : features)
  {
    if (isPlace(feature)) points.push_back(placeOf(feature));
    if (isSegment(feature.type) && feature.size >= kShortest) pieces.push_back(pieceOf(feature));
  }
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    for (std::size_t j = i + 1; j < pieces.size(); ++j)
    {
      const auto at = crossingOf(pieces[i], pieces[j]);
      if (!at || beyond(pieces[i], *at) > kObservedReach) continue;
      if (beyond(pieces[j], *at) > kObservedReach) continue;
      points.push_back(crossingPoint(pieces[i], pieces[j], *at));
    }
  }
  return distinct(std::move(points));
}

std::vector<KeyPoint> mappedKeyPoints(const FeatureMap& map)
{
  std::vector<KeyPoint> points;
  for (const Feature& feature : map.features())
  {
    if (isPlace(feature)) points.push_back(placeOf(feature));
  }
  appendMappedCrossings(map, points);
  return distinct(std::move(points));
}
}  // namespace sigloc
