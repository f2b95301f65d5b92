// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/math/TPoint2D.h>

#include <functional>
#include <string>
#include <utility>

#include "OffscreenRenderer.h"
#include "sigloc/plugin/map_drawing.h"

namespace sigloc
{
/// A picture of a part of the map plane, painted point by point, with axes and room for text above.
class RasterPicture
{
 public:
  /// `box` [m] is what is shown, `top` [pixels] the room above it.
  RasterPicture(const PlanarBox& box, int top);

  /// Paints every pixel with the colour of its place [m].
  void paint(const std::function<mrpt::img::TColor(const mrpt::math::TPoint2D&)>& color_at);
  /// Column and row of a place [m].
  std::pair<int, int> pixelOf(const mrpt::math::TPoint2D& place) const;
  void drawAxes();
  void put(int column, int row, const std::string& text, const mrpt::img::TColor& color);

  mrpt::img::CImage& image() { return image_; }

 private:
  PlanarBox box_;
  int top_;
  double metres_per_pixel_;
  PictureSize size_;
  int map_height_;
  mrpt::img::CImage image_;
};
}  // namespace sigloc
