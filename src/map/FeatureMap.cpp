// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/map/FeatureMap.h"

#include <fmt/core.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kLinkOffset = 0.15;  // [m] of the ends of a fragment from the line of its wall
constexpr double kLinkAngle = 0.08;  // [rad] between normals of fragments of one wall
constexpr double kLinkGap = 4.0;  // [m] opening beyond which two walls are separate
constexpr std::size_t kAngleBins = 72;  // of the hash over directions

void checkFeature(const Feature& feature, std::size_t k)
{
  if (typeIndex(feature.type) >= kFeatureTypes)
  {
    throw std::invalid_argument("FeatureMap: feature " + std::to_string(k) + " has no known type");
  }
  const auto& p = feature.position_covariance;
  const bool finite = std::isfinite(feature.position.x) && std::isfinite(feature.position.y) &&
                      std::isfinite(feature.direction) && std::isfinite(feature.size) &&
                      std::isfinite(feature.direction_variance) &&
                      std::isfinite(feature.size_variance) && std::isfinite(p(0, 0)) &&
                      std::isfinite(p(0, 1)) && std::isfinite(p(1, 0)) && std::isfinite(p(1, 1));
  if (!finite)
  {
    throw std::invalid_argument(fmt::format("FeatureMap: feature {} is not finite", k));
  }
  const double determinant = p(0, 0) * p(1, 1) - p(0, 1) * p(1, 0);
  const double tolerance = 1e-9 * (1e-12 + p(0, 0) * p(1, 1));
  if (p(0, 0) < 0 || p(1, 1) < 0 || determinant < -tolerance || feature.direction_variance < 0 ||
      feature.size_variance < 0)
  {
    throw std::invalid_argument(
        fmt::format("FeatureMap: covariance of feature {} is not positive semi-definite", k));
  }
}

std::size_t angleBin(double direction)
{
  const double share = (wrapToPi(direction) + M_PI) / (2 * M_PI);
  return std::min(kAngleBins - 1, static_cast<std::size_t>(share * kAngleBins));
}

/// True when both ends of `fragment` are on the line of `wall` and both face the same way.
bool onLine(const Feature& wall, const Feature& fragment)
{
  if (std::abs(wrapToPi(wall.direction - fragment.direction)) > kLinkAngle) return false;
  const TPoint2D normal = directionVector(wall);
  const TPoint2D a = segmentStart(fragment) - wall.position;
  const TPoint2D b = segmentEnd(fragment) - wall.position;
  return std::abs(normal.x * a.x + normal.y * a.y) < kLinkOffset &&
         std::abs(normal.x * b.x + normal.y * b.y) < kLinkOffset;
}

/// Separates collinear fragments, ordered along the tangent, where the opening is too wide.
void appendLines(const std::vector<Feature>& features, const Feature& wall,
                 std::vector<std::uint32_t> members, std::vector<WallLine>& lines)
{
  const TPoint2D tangent = tangentVector(wall);
  const auto along = [&](const TPoint2D& p) { return tangent.x * p.x + tangent.y * p.y; };
  std::sort(members.begin(), members.end(),
            [&](std::uint32_t a, std::uint32_t b)
            {
              const double sa = along(segmentStart(features[a]));
              const double sb = along(segmentStart(features[b]));
              return sa != sb ? sa < sb : a < b;
            });
  double reach = 0;
  for (std::size_t i = 0; i < members.size(); ++i)
  {
    const Feature& fragment = features[members[i]];
    if (i == 0 || along(segmentStart(fragment)) > reach + kLinkGap)
    {
      lines.push_back({wall.direction, lineDistance(wall), {}});
      reach = along(segmentEnd(fragment));
    }
    lines.back().members.push_back(members[i]);
    reach = std::max(reach, along(segmentEnd(fragment)));
  }
}
}  // namespace

std::vector<WallLine> linkWalls(const std::vector<Feature>& features)
{
  std::vector<std::uint32_t> order;
  std::vector<std::vector<std::uint32_t>> bins(kAngleBins);
  for (std::uint32_t k = 0; k < features.size(); ++k)
  {
    if (!isSegment(features[k].type)) continue;
    order.push_back(k);
    bins[angleBin(features[k].direction)].push_back(k);
  }
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) {
              return features[a].size != features[b].size ? features[a].size > features[b].size
                                                          : a < b;
            });
  std::vector<bool> linked(features.size(), false);
  std::vector<WallLine> lines;
  for (const std::uint32_t longest : order)
  {
    if (linked[longest]) continue;
    std::vector<std::uint32_t> members;
    const std::size_t bin = angleBin(features[longest].direction);
    for (const std::size_t b : {(bin + kAngleBins - 1) % kAngleBins, bin, (bin + 1) % kAngleBins})
    {
      for (const std::uint32_t k : bins[b])
      {
        if (linked[k] || !(k == longest || onLine(features[longest], features[k]))) continue;
        linked[k] = true;
        members.push_back(k);
      }
    }
    appendLines(features, features[longest], std::move(members), lines);
  }
  return lines;
}

FeatureMap::FeatureMap(std::vector<Feature> features, std::optional<DenseField> field,
                       MapErrorModel error, MapProvenance provenance)
    : features_(std::move(features)),
      line_of_(features_.size(), -1),
      field_(std::move(field)),
      error_(error),
      provenance_(std::move(provenance))
{
  for (std::size_t k = 0; k < features_.size(); ++k) checkFeature(features_[k], k);
  lines_ = linkWalls(features_);
  for (std::size_t l = 0; l < lines_.size(); ++l)
  {
    for (const std::uint32_t k : lines_[l].members) line_of_[k] = static_cast<std::int32_t>(l);
  }
}

double FeatureMap::area() const
{
  if (field_ && field_->free_area > 0) return field_->free_area;
  if (features_.empty()) return 0;
  TPoint2D low = features_.front().position;
  TPoint2D high = low;
  for (const Feature& feature : features_)
  {
    low = {std::min(low.x, feature.position.x), std::min(low.y, feature.position.y)};
    high = {std::max(high.x, feature.position.x), std::max(high.y, feature.position.y)};
  }
  return (high.x - low.x) * (high.y - low.y);
}
}  // namespace sigloc
