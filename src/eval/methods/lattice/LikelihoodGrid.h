// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/map/DenseField.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sigloc
{
/// Likelihood values exp(-d^2 / 2 sigma^2) of the distance d to the nearest wall, as 0..255, row by
/// row. The grid has a border of zeros, so that a look-up anywhere within the border needs no test.
class LikelihoodGrid
{
 public:
  /// `sigma` in [m]; `border` in cells on each side. Throws std::invalid_argument unless sigma > 0.
  LikelihoodGrid(const DenseField& field, double sigma, std::uint32_t border);

  const RasterFrame& frame() const { return frame_; }
  std::int32_t border() const { return border_; }
  /// Cells from one row to the next.
  std::int32_t stride() const { return stride_; }
  std::int32_t rows() const { return rows_; }
  /// Index into values() of a map cell; both coordinates may reach `border` cells outside the map.
  std::size_t indexOf(std::int32_t ix, std::int32_t iy) const
  {
    return static_cast<std::size_t>(iy + border_) * static_cast<std::size_t>(stride_) +
           static_cast<std::size_t>(ix + border_);
  }
  const std::vector<std::uint8_t>& values() const { return values_; }

  /// Returns the value at a position in the map frame, linear between cell centres, in [0, 255].
  /// Zero outside the bordered grid.
  float interpolated(double x, double y) const;

 private:
  RasterFrame frame_;
  std::int32_t border_ = 0;
  std::int32_t stride_ = 0;
  std::int32_t rows_ = 0;
  std::vector<std::uint8_t> values_;
};
}  // namespace sigloc
