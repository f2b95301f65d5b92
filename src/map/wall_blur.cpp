// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/wall_blur.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr double kStep = 0.1;  // [m] between two points of a segment
constexpr double kMargin = 0.2;  // [m] at either end of a segment, where another wall may begin
constexpr double kSameWall = 0.3;  // [m] from a segment, within which a ridge is that of its wall
constexpr double kMostPoints = 20000;  // on all segments
constexpr double kUnit = 1e-4;  // [m] of the offsets that are summed, so that order does not matter

/// Returns the vector [m] from a point to the ridge of its wall, or nothing where there is none.
std::optional<TPoint2D> toRidge(const DenseField& field, const TPoint2D& point)
{
  const DenseCell* cell = cellAt(field, point);
  if (cell == nullptr || cell->distance() * DenseField::kDistanceUnit > kSameWall) return {};
  const RasterFrame& frame = field.frame;
  const auto to_middle = [&](double from_origin)
  {
    const double cells = from_origin / frame.resolution;
    return (std::floor(cells) + 0.5 - cells) * frame.resolution;
  };
  return TPoint2D(to_middle(point.x - frame.origin.x) + cell->dx * DenseField::kOffsetUnit,
                  to_middle(point.y - frame.origin.y) + cell->dy * DenseField::kOffsetUnit);
}
}  // namespace

double wallBlur(const std::vector<Feature>& features, const DenseField& field)
{
  double length = 0;
  for (const Feature& feature : features) length += isSegment(feature.type) ? feature.size : 0;
  const double step = std::max(kStep, length / kMostPoints);
  std::int64_t squares = 0;
  std::int64_t points = 0;
  for (const Feature& feature : features)
  {
    if (!isSegment(feature.type)) continue;
    const TPoint2D normal = directionVector(feature);
    const TPoint2D along(normal.y, -normal.x);
    for (double at = kMargin; at < feature.size - kMargin; at += step)
    {
      const auto ridge = toRidge(field, feature.position + along * (at - 0.5 * feature.size));
      if (!ridge) continue;
      const auto across = std::llround((ridge->x * normal.x + ridge->y * normal.y) / kUnit);
      squares += across * across;
      ++points;
    }
  }
  if (points == 0) return 0;
  return kUnit * std::sqrt(static_cast<double>(squares) / static_cast<double>(points));
}
}  // namespace sigloc
