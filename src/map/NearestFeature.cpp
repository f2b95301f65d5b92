// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/NearestFeature.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/cell_key.h"
#include "geometry/plane_products.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr double kCell = 1.0;  // [m] of the hash
// Features are entered by sample places at most this far apart [m], so a query has to search this
// much farther than its radius.
constexpr double kSpacing = 0.25;
constexpr std::size_t kFewCells = 400;  // always looked up one by one
constexpr double kFarthest = 1e9;  // [m] of a query, whose cell can be numbered

std::int64_t cellIndex(double coordinate)
{
  return static_cast<std::int64_t>(std::floor(coordinate / kCell));
}

std::vector<TPoint2D> samplesOf(const Feature& feature)
{
  std::vector<TPoint2D> samples;
  if (isSegment(feature.type))
  {
    const TPoint2D start = segmentStart(feature);
    const auto steps = static_cast<int>(std::ceil(feature.size / kSpacing)) + 1;
    for (int i = 0; i <= steps; ++i)
    {
      samples.push_back(start + tangentVector(feature) * (feature.size * i / steps));
    }
  }
  else if (isRound(feature.type))
  {
    const auto steps = static_cast<int>(std::ceil(2 * M_PI * feature.size / kSpacing)) + 3;
    for (int i = 0; i < steps; ++i)
    {
      const double angle = 2 * M_PI * i / steps;
      samples.push_back(feature.position +
                        TPoint2D(std::cos(angle), std::sin(angle)) * feature.size);
    }
  }
  else
  {
    samples.push_back(feature.position);
  }
  return samples;
}
}  // namespace

TPoint2D nearestPlaceOn(const Feature& feature, const TPoint2D& point)
{
  const TPoint2D to_point = point - feature.position;
  if (isSegment(feature.type))
  {
    const TPoint2D tangent = tangentVector(feature);
    const double along = dot(tangent, to_point);
    return feature.position + tangent * std::clamp(along, -0.5 * feature.size, 0.5 * feature.size);
  }
  if (isRound(feature.type))
  {
    const double norm = to_point.norm();
    const TPoint2D outward = norm > 0 ? to_point * (1.0 / norm) : directionVector(feature);
    return feature.position + outward * feature.size;
  }
  return feature.position;
}

NearestFeature::NearestFeature(std::vector<Feature> features) : features_(std::move(features))
{
  for (std::size_t k = 0; k < features_.size(); ++k)
  {
    for (const TPoint2D& sample : samplesOf(features_[k]))
    {
      auto& cell = cells_[cellKey(cellIndex(sample.x), cellIndex(sample.y))];
      const auto index = static_cast<std::uint32_t>(k);
      if (cell.empty() || cell.back() != index) cell.push_back(index);
    }
  }
}

std::optional<NearestFeature::Hit> NearestFeature::find(const TPoint2D& point, double radius) const
{
  std::optional<Hit> best;
  const auto look = [&](std::uint32_t k)
  {
    const TPoint2D place = nearestPlaceOn(features_[k], point);
    const double distance = (place - point).norm();
    if (!(distance <= radius)) return;
    const bool better =
        !best || distance < best->distance || (distance == best->distance && k < best->feature);
    if (better) best = Hit{k, place, distance};
  };
  const double reach = radius + kSpacing;
  // In a large circle there are more cells than features.
  const double cells_across = 2 * reach / kCell + 2;
  if (!(cells_across * cells_across < static_cast<double>(features_.size() + kFewCells)) ||
      !(std::abs(point.x) + std::abs(point.y) < kFarthest))
  {
    for (std::uint32_t k = 0; k < features_.size(); ++k) look(k);
    return best;
  }
  for (std::int64_t y = cellIndex(point.y - reach); y <= cellIndex(point.y + reach); ++y)
  {
    for (std::int64_t x = cellIndex(point.x - reach); x <= cellIndex(point.x + reach); ++x)
    {
      const auto cell = cells_.find(cellKey(x, y));
      if (cell == cells_.end()) continue;
      for (const std::uint32_t k : cell->second) look(k);
    }
  }
  return best;
}
}  // namespace sigloc
