// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>

#include <cstdint>
#include <cstdlib>

namespace sigloc::test
{
/// How many pixels have about this colour.
inline int pixelsLike(const mrpt::img::CImage& picture, const mrpt::img::TColor& color)
{
  constexpr int kTolerance = 12;
  const bool bgr = picture.getChannelsOrder() == "BGR";
  int count = 0;
  for (unsigned row = 0; row < picture.getHeight(); ++row)
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
