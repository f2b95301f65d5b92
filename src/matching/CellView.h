// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cmath>
#include <cstddef>

#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Look-up of cells by map coordinates; outside lies one cell that knows nothing.
class CellView
{
 public:
  explicit CellView(const DenseField& field)
      : cells_(field.cells.data()),
        x0_(static_cast<float>(field.frame.origin.x)),
        y0_(static_cast<float>(field.frame.origin.y)),
        scale_(static_cast<float>(1.0 / field.frame.resolution)),
        resolution_(static_cast<float>(field.frame.resolution)),
        width_(field.frame.width),
        height_(field.frame.height)
  {
  }

  const DenseCell& at(float x, float y) const
  {
    const float fx = (x - x0_) * scale_;
    const float fy = (y - y0_) * scale_;
    if (!(fx >= 0 && fy >= 0 && fx < static_cast<float>(width_) &&
          fy < static_cast<float>(height_)))
    {
      return outside_;
    }
    return cells_[static_cast<std::size_t>(fy) * width_ + static_cast<std::size_t>(fx)];
  }

  /// The vector from the ridge of the nearest wall to (x, y) [m]; false when there is none within
  /// the field's reach.
  bool offsetToWall(float x, float y, float& ex, float& ey) const
  {
    const float fx = (x - x0_) * scale_;
    const float fy = (y - y0_) * scale_;
    if (!(fx >= 0 && fy >= 0 && fx < static_cast<float>(width_) &&
          fy < static_cast<float>(height_)))
    {
      return false;
    }
    const auto ix = static_cast<std::int32_t>(fx);
    const auto iy = static_cast<std::int32_t>(fy);
    const DenseCell& cell =
        cells_[static_cast<std::size_t>(iy) * width_ + static_cast<std::size_t>(ix)];
    constexpr auto kUnit = static_cast<float>(DenseField::kOffsetUnit);
    ex = (fx - static_cast<float>(ix) - 0.5F) * resolution_ - static_cast<float>(cell.dx) * kUnit;
    ey = (fy - static_cast<float>(iy) - 0.5F) * resolution_ - static_cast<float>(cell.dy) * kUnit;
    return cell.distance != 255;
  }

 private:
  const DenseCell* cells_;
  float x0_, y0_, scale_, resolution_;
  std::size_t width_, height_;
  DenseCell outside_;
};

/// A pose with its rotation worked out.
struct Placement
{
  explicit Placement(const mrpt::math::TPose2D& pose)
      : x(static_cast<float>(pose.x)),
        y(static_cast<float>(pose.y)),
        c(static_cast<float>(std::cos(pose.phi))),
        s(static_cast<float>(std::sin(pose.phi)))
  {
  }
  float placedX(float px, float py) const { return x + c * px - s * py; }
  float placedY(float px, float py) const { return y + s * px + c * py; }
  float x, y, c, s;
};

}  // namespace sigloc
