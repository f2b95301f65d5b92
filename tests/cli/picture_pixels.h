// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace sigloc::test
{
/// How many pixels have about this colour, in the rows from `first_row` to before `end_row`.
inline int pixelsLike(const mrpt::img::CImage& picture, const mrpt::img::TColor& color,
                      unsigned first_row = 0, std::size_t end_row = SIZE_MAX)
{
  constexpr int kTolerance = 12;
  const bool bgr = picture.getChannelsOrder() == "BGR";
  int count = 0;
  const std::size_t last = std::min(end_row, picture.getHeight());
  for (unsigned row = first_row; row < last; ++row)
  {
    for (unsigned column = 0; column < picture.getWidth(); ++column)
    {
      const auto* const pixel = picture.ptr<std::uint8_t>(column, row);
      if (std::abs(pixel[bgr ? 2 : 0] - color.R) < kTolerance &&
          std::abs(pixel[1] - color.G) < kTolerance &&
          std::abs(pixel[bgr ? 0 : 2] - color.B) < kTolerance)
      {
        ++count;
      }
    }
  }
  return count;
}
}  // namespace sigloc::test
