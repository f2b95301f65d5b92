// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RasterPicture.h"

#include <algorithm>
#include <cmath>

#include "picture_axes.h"

namespace sigloc
{
using mrpt::img::TColor;
using mrpt::math::TPoint2D;

namespace
{
constexpr double kLongSide = 1500;  // [pixels] of the map
constexpr double kLeastWidth = 900;
constexpr int kBottom = 60;  // [pixels] for the axis
constexpr const char* kFont = "10x20";
const TColor kText(20, 20, 20);
}  // namespace

RasterPicture::RasterPicture(const PlanarBox& box, int top) : box_(box), top_(top)
{
  const double width = box.x_max - box.x_min;
  const double height = box.y_max - box.y_min;
  metres_per_pixel_ = std::max({width, height, 1e-3}) / kLongSide;
  size_.width = static_cast<unsigned>(std::max(kLeastWidth, std::ceil(width / metres_per_pixel_)));
  map_height_ = static_cast<int>(std::ceil(height / metres_per_pixel_));
  size_.height = static_cast<unsigned>(map_height_ + top + kBottom);
  image_ = mrpt::img::CImage(size_.width, size_.height, mrpt::img::CH_RGB);
  image_.filledRectangle(0, 0, static_cast<int>(size_.width) - 1,
                         static_cast<int>(size_.height) - 1, TColor(255, 255, 255));
}

void RasterPicture::paint(const std::function<TColor(const TPoint2D&)>& color_at)
{
  for (int row = 0; row < map_height_; ++row)
  {
    for (int column = 0; column < static_cast<int>(size_.width); ++column)
    {
      const TPoint2D place(box_.x_min + (column + 0.5) * metres_per_pixel_,
                           box_.y_max - (row + 0.5) * metres_per_pixel_);
      image_.setPixel(column, top_ + row, static_cast<std::size_t>(color_at(place)));
    }
  }
}

std::pair<int, int> RasterPicture::pixelOf(const TPoint2D& place) const
{
  return {static_cast<int>(std::lround((place.x - box_.x_min) / metres_per_pixel_)),
          top_ + static_cast<int>(std::lround((box_.y_max - place.y) / metres_per_pixel_))};
}

void RasterPicture::drawAxes()
{
  View view;
  view.height = metres_per_pixel_ * size_.height;
  view.x = box_.x_min + 0.5 * metres_per_pixel_ * size_.width;
  view.y = box_.y_max + top_ * metres_per_pixel_ - 0.5 * view.height;
  const PictureAxes axes(view, size_, kBottom - 4);
  axes.write([&](double x, double y, const std::string& text)
             { put(static_cast<int>(x), static_cast<int>(size_.height - y) - 14, text, kText); });
  axes.draw(image_);
}

void RasterPicture::put(int column, int row, const std::string& text, const TColor& color)
{
  image_.selectTextFont(kFont);
  image_.textOut(column, row, text, color);
}
}  // namespace sigloc
