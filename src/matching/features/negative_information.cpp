// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/features/negative_information.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
/// Returns the corners of the convex hull, counter-clockwise.
std::vector<TPoint2D> convexHull(std::vector<TPoint2D> points)
{
  std::sort(points.begin(), points.end(),
            [](const TPoint2D& a, const TPoint2D& b)
            { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<TPoint2D> hull;
  const auto add = [&](const TPoint2D& p, std::size_t from)
  {
    while (hull.size() >= from + 2 &&
           cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
    {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const TPoint2D& p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t k = points.size() - 1; k-- > 0;) add(points[k], lower);
  hull.pop_back();
  return hull;
}

bool insideBy(const std::vector<TPoint2D>& hull, const TPoint2D& p, double margin)
{
  for (std::size_t k = 0; k < hull.size(); ++k)
  {
    const TPoint2D side = hull[(k + 1) % hull.size()] - hull[k];
    if (cross(side, p - hull[k]) < margin * std::sqrt(dot(side, side))) return false;
  }
  return true;
}
using SeenTypes = std::array<bool, kFeatureTypes>;

/// Returns the number of unpaired mapped places of these types inside the hull of `places` (map
/// frame), and adds what it reads of the grid to `visits`.
std::size_t countMissedWithin(std::vector<TPoint2D> places, const SeenTypes& types,
                              const PreparedMap& map, const std::vector<FeaturePairing>& pairings,
                              std::uint64_t& visits)
{
  if (places.size() < 3) return 0;
  TPoint2D middle{0, 0};
  for (const TPoint2D& place : places)
  {
    middle = middle + place * (1 / static_cast<double>(places.size()));
  }
  double reach = 0;
  for (const TPoint2D& place : places) reach = std::max(reach, (place - middle).norm());
  const std::vector<TPoint2D> hull = convexHull(std::move(places));
  if (hull.size() < 3) return 0;

  constexpr double kMargin = 0.2;  // [m] from the rim, where a place may be seen or not
  std::size_t missed = 0;
  for (std::size_t t = 0; t < kFeatureTypes; ++t)
  {
    if (!types[t]) continue;
    const auto count = [&](std::uint32_t p)
    {
      const bool paired =
          std::any_of(pairings.begin(), pairings.end(),
                      [&](const FeaturePairing& pairing) { return pairing.mapped == p; });
      missed += !paired && insideBy(hull, map.view(p).position(), kMargin);
    };
    visits += map.grid().visitNear(middle, reach, static_cast<FeatureType>(t), count);
  }
  return missed;
}
}  // namespace

std::size_t countMissed(const PreparedScene& scene, const PreparedMap& map,
                        const PoseEstimate& pose, const std::vector<FeaturePairing>& pairings,
                        MatchingCounters& counters)
{
  std::vector<TPoint2D> places;
  SeenTypes types{};
  for (const FeaturePairing& pairing : pairings)
  {
    const DirectedFeature& view = scene.views[pairing.observed];
    if (!isPointLike(view.type())) continue;
    places.push_back(pose.place(view.position()));
    types[typeIndex(view.type())] = true;
  }
  return countMissedWithin(std::move(places), types, map, pairings, counters.visits);
}

std::size_t countMissedInView(const PreparedScene& scene, const PreparedMap& map,
                              const PoseEstimate& pose, const std::vector<FeaturePairing>& pairings)
{
  std::vector<TPoint2D> places;
  SeenTypes types{};
  for (const DirectedFeature& view : scene.views)
  {
    if (!isPointLike(view.type()) || hasBearing(view.type())) continue;
    places.push_back(pose.place(view.position()));
    types[typeIndex(view.type())] = true;
  }
  std::uint64_t not_counted = 0;  // no part of a relocation
  return countMissedWithin(std::move(places), types, map, pairings, not_counted);
}
}  // namespace sigloc
