// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/lattice/LikelihoodGrid.h"

#include <array>
#include <cmath>
#include <stdexcept>

namespace sigloc
{
LikelihoodGrid::LikelihoodGrid(const DenseField& field, double sigma, std::uint32_t border)
    : frame_(field.frame), border_(static_cast<std::int32_t>(border))
{
  if (!(sigma > 0)) throw std::invalid_argument("LikelihoodGrid: sigma must be positive");
  const auto width = static_cast<std::int32_t>(frame_.width);
  const auto height = static_cast<std::int32_t>(frame_.height);
  stride_ = width + 2 * border_;
  rows_ = height + 2 * border_;
  values_.assign(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows_), 0);

  std::array<std::uint8_t, DenseCell::kFar + 1> value_of_distance{};
  for (std::size_t d = 0; d < DenseCell::kFar;
       ++d)  // kFar is beyond the field's largest distance: zero
  {
    const double ratio = static_cast<double>(d) * DenseField::kDistanceUnit / sigma;
    value_of_distance[d] =
        static_cast<std::uint8_t>(std::lround(255.0 * std::exp(-0.5 * ratio * ratio)));
  }
  for (std::int32_t iy = 0; iy < height; ++iy)
  {
    const DenseCell* row = &field.cells[static_cast<std::size_t>(iy) * frame_.width];
    std::uint8_t* out = &values_[indexOf(0, iy)];
    for (std::int32_t ix = 0; ix < width; ++ix) out[ix] = value_of_distance[row[ix].distance()];
  }
}

float LikelihoodGrid::interpolated(double x, double y) const
{
  // Cell centres carry the values, hence the half cell.
  const double u = (x - frame_.origin.x) / frame_.resolution - 0.5 + border_;
  const double v = (y - frame_.origin.y) / frame_.resolution - 0.5 + border_;
  if (!(u >= 0 && v >= 0 && u < stride_ - 1 && v < rows_ - 1)) return 0.0F;
  const auto ix = static_cast<std::size_t>(u);
  const auto iy = static_cast<std::size_t>(v);
  const auto fx = static_cast<float>(u - static_cast<double>(ix));
  const auto fy = static_cast<float>(v - static_cast<double>(iy));
  const std::uint8_t* low = &values_[iy * static_cast<std::size_t>(stride_) + ix];
  const std::uint8_t* high = low + stride_;
  const float bottom = static_cast<float>(low[0]) * (1 - fx) + static_cast<float>(low[1]) * fx;
  const float top = static_cast<float>(high[0]) * (1 - fx) + static_cast<float>(high[1]) * fx;
  return bottom * (1 - fy) + top * fy;
}
}  // namespace sigloc
