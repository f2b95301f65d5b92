// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Casts rays through a dense field, in steps of the distance to the nearest wall.
/// Keeps a reference to the field, which must outlive it.
class RayCaster
{
 public:
  explicit RayCaster(const DenseField& field) : field_(field) {}

  const DenseField& field() const { return field_; }

  /// Returns the range [m] at which a ray from `origin` [m, map frame] along `angle` [rad] meets a
  /// wall. Returns nullopt when it leaves the raster or meets none within `max_range` [m].
  std::optional<double> cast(const mrpt::math::TPoint2D& origin, double angle,
                             double max_range) const;

  /// Visits cells along a ray, from `start` [m] on, so that no wall is stepped over:
  /// `visit(range [m], cell)` returns whether to go on. Returns the range of the cell where it did
  /// not; nullopt where the ray has left the raster or reached `max_range` [m]. Two cells are at
  /// most `stride` [m] apart.
  template <class Visit>
  std::optional<double> walk(const mrpt::math::TPoint2D& origin, double angle, double start,
                             double max_range, double stride, const Visit& visit) const
  {
    const RasterFrame& frame = field_.frame;
    const double resolution = frame.resolution;
    const double dx = std::cos(angle);
    const double dy = std::sin(angle);
    const double x0 = (origin.x - frame.origin.x) / resolution;
    const double y0 = (origin.y - frame.origin.y) / resolution;
    const double limit = max_range / resolution;
    const double longest = stride / resolution;
    const double far = truncationDistance(resolution);
    double along = start / resolution;  // [cells]
    while (along < limit)
    {
      const double x = x0 + along * dx;
      const double y = y0 + along * dy;
      if (!(x >= 0 && y >= 0 && x < frame.width && y < frame.height)) return std::nullopt;
      const auto ix = static_cast<std::size_t>(x);
      const auto iy = static_cast<std::size_t>(y);
      const DenseCell& cell = field_.at(ix, iy);
      if (!visit(along * resolution, cell)) return along * resolution;
      // The distance is between cell centres. A ray may be nearer by up to two half diagonals, and
      // the distance may have been rounded up.
      const double distance = std::min(far, (cell.distance() - 0.5) * DenseField::kDistanceUnit);
      const double clear = distance / resolution - 1.42;
      along += std::clamp(clear, 0.35, std::max(longest, 0.35));
    }
    return std::nullopt;
  }

 private:
  const DenseField& field_;
};
}  // namespace sigloc
