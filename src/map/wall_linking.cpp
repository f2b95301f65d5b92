// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/wall_linking.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/plane_products.h"
#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kLinkOffset = 0.15;  // [m] of the ends of a fragment from the line of its wall
constexpr double kLinkAngle = 0.08;  // [rad] between normals of fragments of one wall
constexpr double kLinkGap = 4.0;  // [m] opening beyond which two walls are separate
constexpr double kHashCell = 2 * kSegmentReach;  // [m]; segments are hashed at this spacing

/// True when both ends of `fragment` are on the line of `wall`, which has this normal, and both
/// face the same way.
bool onLine(const Feature& wall, const TPoint2D& normal, const Feature& fragment)
{
  if (std::abs(wrapToPi(wall.direction - fragment.direction)) > kLinkAngle) return false;
  const TPoint2D a = segmentStart(fragment) - wall.position;
  const TPoint2D b = segmentEnd(fragment) - wall.position;
  return std::abs(dot(normal, a)) < kLinkOffset && std::abs(dot(normal, b)) < kLinkOffset;
}

/// Gathers the fragments of one wall: from its longest fragment along its line, as far as openings
/// are small. What lies on the same line beyond is another wall.
class WallGatherer
{
 public:
  WallGatherer(const std::vector<Feature>& features, const CellHash& hash,
               std::vector<bool>& linked, std::uint32_t longest)
      : features_(features),
        hash_(hash),
        linked_(linked),
        wall_(features[longest]),
        normal_(directionVector(wall_)),
        tangent_(tangentVector(wall_))
  {
    take(longest);
  }

  /// Returns the fragments by position along the tangent.
  std::vector<std::uint32_t> gather()
  {
    double right = low_;
    double left = low_;
    bool walking = true;
    while (walking)
    {
      walking = false;
      for (; right < high_ + kLinkGap + kHashCell; right += kHashCell, walking = true) look(right);
      for (; left > low_ - kLinkGap - kHashCell; left -= kHashCell, walking = true) look(left);
    }
    std::sort(members_.begin(), members_.end());
    std::vector<std::uint32_t> indices;
    indices.reserve(members_.size());
    for (const auto& [start, k] : members_) indices.push_back(k);
    return indices;
  }

 private:
  double along(const TPoint2D& p) const
  {
    const TPoint2D d = p - wall_.position;
    return dot(tangent_, d);
  }

  void take(std::uint32_t k)
  {
    linked_[k] = true;
    const double start = along(segmentStart(features_[k]));
    members_.emplace_back(start, k);
    low_ = std::min(low_, start);
    high_ = std::max(high_, along(segmentEnd(features_[k])));
  }

  /// Takes the fragments near a position along the line that belong to the wall so far. One beyond
  /// an opening that is still too wide is found again when the wall has grown.
  void look(double position)
  {
    hash_.forEachNear(wall_.position + tangent_ * position,
                      [&](std::uint32_t k)
                      {
                        const Feature& fragment = features_[k];
                        if (linked_[k] || !onLine(wall_, normal_, fragment)) return;
                        if (along(segmentStart(fragment)) > high_ + kLinkGap) return;
                        if (along(segmentEnd(fragment)) < low_ - kLinkGap) return;
                        take(k);
                      });
  }

  const std::vector<Feature>& features_;
  const CellHash& hash_;
  std::vector<bool>& linked_;
  const Feature& wall_;
  TPoint2D normal_, tangent_;
  std::vector<std::pair<double, std::uint32_t>> members_;
  double low_ = 0;  // [m] along the tangent from the middle of the longest
  double high_ = 0;
};
}  // namespace

CellHash segmentHash(const std::vector<Feature>& features)
{
  CellHash hash(kHashCell);
  for (std::uint32_t k = 0; k < features.size(); ++k)
  {
    const Feature& segment = features[k];
    if (!isSegment(segment.type)) continue;
    const TPoint2D start = segmentStart(segment);
    const TPoint2D tangent = tangentVector(segment);
    const double pieces = std::max(1.0, std::ceil(segment.size / kHashCell));
    for (double i = 0; i <= pieces; ++i) hash.add(start + tangent * (segment.size * i / pieces), k);
  }
  return hash;
}

std::vector<WallLine> linkWalls(const std::vector<Feature>& features)
{
  std::vector<std::uint32_t> longest_first;
  for (std::uint32_t k = 0; k < features.size(); ++k)
  {
    if (isSegment(features[k].type)) longest_first.push_back(k);
  }
  std::sort(longest_first.begin(), longest_first.end(),
            [&](std::uint32_t a, std::uint32_t b) {
              return features[a].size != features[b].size ? features[a].size > features[b].size
                                                          : a < b;
            });
  const CellHash hash = segmentHash(features);
  std::vector<bool> linked(features.size(), false);
  std::vector<WallLine> lines;
  for (const std::uint32_t longest : longest_first)
  {
    if (linked[longest]) continue;
    const Feature& wall = features[longest];
    WallGatherer gatherer(features, hash, linked, longest);
    lines.push_back({wall.direction, lineDistance(wall), gatherer.gather()});
  }
  return lines;
}
}  // namespace sigloc
