// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/RayCaster.h"

#include <algorithm>
#include <cmath>

namespace sigloc
{
std::optional<double> RayCaster::cast(const mrpt::math::TPoint2D& origin, double angle,
                                      double max_range) const
{
  const RasterFrame& frame = field_.frame;
  const double resolution = frame.resolution;
  const double dx = std::cos(angle);
  const double dy = std::sin(angle);
  const double x0 = (origin.x - frame.origin.x) / resolution;
  const double y0 = (origin.y - frame.origin.y) / resolution;
  const double limit = max_range / resolution;
  const double far = truncationDistance(resolution);
  double along = 0;  // [cells]
  while (along < limit)
  {
    const double x = x0 + along * dx;
    const double y = y0 + along * dy;
    if (!(x >= 0 && y >= 0 && x < frame.width && y < frame.height)) return std::nullopt;
    const auto ix = static_cast<std::size_t>(x);
    const auto iy = static_cast<std::size_t>(y);
    const DenseCell& cell = field_.cells[iy * frame.width + ix];
    if (isWall(cell.state)) return along * resolution;
    // The distance is between cell centres. A ray may be nearer by up to two half diagonals, and
    // the byte may have been rounded up.
    const double distance = std::min(far, (cell.distance - 0.5) * DenseField::kDistanceUnit);
    const double clear = distance / resolution - 1.42;
    along += std::max(clear, 0.35);
  }
  return std::nullopt;
}
}  // namespace sigloc
