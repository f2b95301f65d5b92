// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/merged_features.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "geometry/CellHash.h"
#include "geometry/plane_products.h"
#include "map/building/walk_along.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kPoseSigma = 0.03;  // [m] of the poses of the scans, eq. (2.7)
constexpr double kHeadingSigma = 0.01;  // [rad] of the headings of the scans
constexpr double kEndNearCorner = 0.3;  // [m] within which a wall end is that of a corner
constexpr double kPostRadii = 4;  // of a circle; on a longer wall it is a part of the wall
constexpr double kWidestPost = 5;  // [m] radius; wider circles are kept
constexpr double kWallStep = 0.5;  // [m] between the points by which walls are found

/// Sets the covariance of a merged place. Averaging reduces the errors that are independent between
/// scans, including those of the poses, down to a floor. Eq. (2.7)
void setPlaceCovariance(Feature& feature)
{
  const double n = std::min(feature.sightings, 9U);
  for (int k = 0; k < 2; ++k)
  {
    for (int l = 0; l < 2; ++l) feature.position_covariance(k, l) /= n;
    feature.position_covariance(k, k) += kPoseSigma * kPoseSigma / n + 1e-4;
  }
  feature.direction_variance = feature.direction_variance / n + kHeadingSigma * kHeadingSigma;
}

void setSegmentCovariance(Feature& segment, std::uint32_t sightings)
{
  const double n = std::min(sightings, 9U);
  const double across = kPoseSigma * kPoseSigma / n + 1e-4;
  const double along = 0.05 * 0.05;
  const double c = std::cos(segment.direction);
  const double s = std::sin(segment.direction);
  segment.position_covariance(0, 0) = across * c * c + along * s * s;
  segment.position_covariance(1, 1) = across * s * s + along * c * c;
  segment.position_covariance(0, 1) = segment.position_covariance(1, 0) = (across - along) * s * c;
  const double lever = std::max(segment.size, 0.3);
  segment.direction_variance =
      kHeadingSigma * kHeadingSigma / n + 12.0 * 1e-4 / (lever * lever * n);
  segment.size_variance = 2 * along;
  segment.sightings = sightings;
}

/// Returns the end of one of the two walls that meet in a convex corner. Most scans see one of the
/// faces only, which ends in a jump.
Feature wallEndOfCorner(const Feature& corner, WallSide side)
{
  const double turn = M_PI - corner.size;
  const bool first = side == WallSide::end;  // the first wall ends here, the second one starts
  const double normal = corner.direction + (first ? -0.5 : 0.5) * turn;
  Feature end = corner;
  end.type = FeatureType::wall_end;
  end.side = side;
  end.direction = wrapToPi(first ? normal + 0.5 * M_PI : normal - 0.5 * M_PI);
  end.size = 0;
  return end;
}

/// Leaves out the circles that are parts of a wall: they touch one that is longer than two of their
/// diameters. Walls of rough cells have gaps, behind which a piece looks like a post. `reach` is
/// the largest distance [m] of a circle that touches a wall.
void removeCirclesInWalls(std::vector<Feature>& places, const std::vector<Feature>& walls,
                          double reach)
{
  const auto may_be_part = [](const Feature& place)
  { return place.type == FeatureType::circle && place.size <= kWidestPost; };
  double widest = 0;
  for (const Feature& place : places)
  {
    if (may_be_part(place)) widest = std::max(widest, place.size);
  }
  CellHash near(widest + reach + kWallStep);
  for (std::uint32_t k = 0; k < walls.size(); ++k)
  {
    walkAlong(walls[k], kWallStep, 0, [&](const TPoint2D& p) { near.add(p, k); });
  }
  const auto touches = [&](const Feature& circle, const Feature& wall)
  {
    const TPoint2D from = circle.position - wall.position;
    const TPoint2D n = directionVector(wall);
    const TPoint2D t = tangentVector(wall);
    return std::abs(dot(from, t)) < 0.5 * wall.size && std::abs(dot(from, n)) < circle.size + reach;
  };
  const auto in_a_wall = [&](const Feature& place)
  {
    bool found = false;
    if (!may_be_part(place)) return found;
    near.forEachNear(
        place.position,
        [&](std::uint32_t k) {
          found = found || (walls[k].size > kPostRadii * place.size && touches(place, walls[k]));
        });
    return found;
  };
  places.erase(std::remove_if(places.begin(), places.end(), in_a_wall), places.end());
}

std::vector<Feature> segmentsOf(const std::vector<MergedWall>& walls)
{
  std::vector<Feature> segments;
  segments.reserve(walls.size());
  for (const MergedWall& wall : walls)
  {
    Feature segment = wall.line;
    setSegmentCovariance(segment, wall.sightings);
    segment.start_seen = segment.end_seen = false;
    segments.push_back(segment);
  }
  return segments;
}

std::vector<Feature> oftenSeen(const std::vector<MergedPlace>& places, std::uint32_t least)
{
  std::vector<Feature> out;
  for (const MergedPlace& merged : places)
  {
    if (merged.feature.sightings < least) continue;
    out.push_back(merged.feature);
    setPlaceCovariance(out.back());
  }
  return out;
}

/// Appends the wall ends of convex corners, where none was seen.
void completeCorners(std::vector<Feature>& places)
{
  CellHash ends(kEndNearCorner);
  const std::size_t seen = places.size();
  for (std::uint32_t k = 0; k < seen; ++k)
  {
    if (places[k].type == FeatureType::wall_end) ends.add(places[k].position, k);
  }
  for (std::size_t c = 0; c < seen; ++c)
  {
    if (places[c].type != FeatureType::corner || places[c].size < M_PI) continue;
    for (const WallSide side : {WallSide::start, WallSide::end})
    {
      const Feature end = wallEndOfCorner(places[c], side);
      bool known = false;
      ends.forEachNear(
          end.position,
          [&](std::uint32_t k)
          {
            const Feature& other = places[k];
            known = known || (other.side == end.side &&
                              (other.position - end.position).norm() < kEndNearCorner &&
                              std::abs(wrapToPi(other.direction - end.direction)) < kMostPlaceTurn);
          });
      if (!known) places.push_back(end);
    }
  }
}
}  // namespace

std::vector<Feature> mergedFeatures(const std::vector<MergedWall>& walls,
                                    const std::vector<MergedPlace>& places,
                                    const MapBuildingOptions& options)
{
  std::vector<Feature> out = segmentsOf(walls);
  std::vector<Feature> others = oftenSeen(places, options.min_sightings);
  completeCorners(others);
  removeCirclesInWalls(others, out, options.merge_offset);
  out.insert(out.end(), others.begin(), others.end());
  return out;
}
}  // namespace sigloc
