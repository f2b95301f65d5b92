// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

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

  /// Returns the range [m] at which a ray from `origin` [m, map frame] along `angle` [rad] meets a
  /// wall. Returns nullopt when it leaves the raster or meets none within `max_range` [m].
  std::optional<double> cast(const mrpt::math::TPoint2D& origin, double angle,
                             double max_range) const;

 private:
  const DenseField& field_;
};
}  // namespace sigloc
