// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/round_walls.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <optional>

#include "geometry/plane_products.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr std::size_t kLeastPieces = 3;  // of a round wall
constexpr std::size_t kNeighbours = 2;  // pieces after one that are tried with it as a circle
constexpr double kLeastBend = 0.1;  // sine of the angle between two pieces that give a circle
constexpr double kLeastRadius = 0.6;  // [m]; posts are circles of their own
constexpr double kMostRadius = 25;  // [m]
constexpr double kOnCircle = 0.15;  // [m] from the circle to the middle of a piece
constexpr double kOffTangent = 0.25;  // sine of the angle between a piece and the circle's tangent
constexpr double kMostSagitta = 0.13;  // [m]; the extractor splits what is more bent

struct Piece
{
  std::size_t feature;  // index
  TPoint2D middle, normal;
  double length;  // [m]
};

struct Circle
{
  TPoint2D centre;
  double radius;  // [m], positive where the centre is before the wall, as in a round room
};

/// Returns the circle of which two pieces are chords: its centre is where their bisectors meet.
std::optional<Circle> circleOf(const Piece& a, const Piece& b)
{
  const double bend = cross(a.normal, b.normal);
  if (std::abs(bend) < kLeastBend) return std::nullopt;
  const TPoint2D between = b.middle - a.middle;
  const double from_a = cross(between, b.normal) / bend;
  const double from_b = cross(between, a.normal) / bend;
  const double radius = (from_a + from_b) / 2;
  if (std::abs(from_a - from_b) > 2 * kOnCircle) return std::nullopt;
  if (std::abs(radius) < kLeastRadius || std::abs(radius) > kMostRadius) return std::nullopt;
  return Circle{a.middle + a.normal * from_a, radius};
}

bool isOn(const Circle& circle, const Piece& piece)
{
  if (piece.length * piece.length > 8 * kMostSagitta * std::abs(circle.radius)) return false;
  const TPoint2D to_centre = circle.centre - piece.middle;
  const double distance = to_centre.norm();
  return std::abs(distance - std::abs(circle.radius)) < kOnCircle &&
         dot(to_centre, piece.normal) * circle.radius > 0 &&
         std::abs(cross(to_centre, piece.normal)) < kOffTangent * distance;
}

std::vector<Piece> piecesOn(const Circle& circle, const std::vector<Piece>& pieces)
{
  std::vector<Piece> on;
  std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(on),
               [&](const Piece& piece) { return isOn(circle, piece); });
  return on;
}

double lengthOf(const std::vector<Piece>& pieces)
{
  return std::accumulate(pieces.begin(), pieces.end(), 0.0,
                         [](double sum, const Piece& piece) { return sum + piece.length; });
}

/// Returns the pieces on the circle that has the greatest length of them; none where no circle has
/// enough pieces.
std::vector<Piece> longestRoundWall(const std::vector<Piece>& pieces)
{
  std::vector<Piece> longest;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    for (std::size_t j = i + 1; j < std::min(pieces.size(), i + 1 + kNeighbours); ++j)
    {
      const std::optional<Circle> circle = circleOf(pieces[i], pieces[j]);
      if (!circle) continue;
      std::vector<Piece> on = piecesOn(*circle, pieces);
      const bool is_wall = on.size() >= kLeastPieces;
      if (is_wall && lengthOf(on) > lengthOf(longest)) longest = std::move(on);
    }
  }
  return longest;
}
}  // namespace

std::vector<bool> onRoundWalls(const std::vector<Feature>& features)
{
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k < features.size(); ++k)
  {
    const Feature& feature = features[k];
    if (!isSegment(feature.type)) continue;
    pieces.push_back({k, feature.position, directionVector(feature), feature.size});
  }
  std::vector<bool> on_round(features.size(), false);
  while (true)
  {
    const std::vector<Piece> wall = longestRoundWall(pieces);
    if (wall.empty()) return on_round;
    for (const Piece& piece : wall) on_round[piece.feature] = true;
    const auto is_taken = [&](const Piece& piece) { return on_round[piece.feature]; };
    pieces.erase(std::remove_if(pieces.begin(), pieces.end(), is_taken), pieces.end());
  }
}
}  // namespace sigloc
