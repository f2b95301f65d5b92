// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/RayCaster.h"

namespace sigloc
{
std::optional<double> RayCaster::cast(const mrpt::math::TPoint2D& origin, double angle,
                                      double max_range) const
{
  return walk(origin, angle, 0, max_range, max_range,
              [](double, const DenseCell& cell) { return !isWall(cell.state()); });
}
}  // namespace sigloc
