// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/opengl/COpenGLViewport.h>

#include <functional>
#include <string>

#include "OffscreenRenderer.h"

namespace sigloc
{
/// Puts a text into a picture: pixels from the left and lower edge, the text.
using PutText = std::function<void(double x, double y, const std::string& text)>;

/// The axes of a picture from straight above, in metres of the map frame. The x axis is a line
/// `base` [pixels] above the lower edge, with a scale bar below it. The y axis is the right edge.
class PictureAxes
{
 public:
  PictureAxes(const View& view, const PictureSize& size, double base);

  /// Writes the numbers, before the scene is rendered; at most kMostTexts.
  void write(const PutText& put) const;
  /// Draws lines and ticks into the rendered picture.
  void draw(mrpt::img::CImage& picture) const;

  static constexpr std::size_t kMostTexts = 64;

 private:
  double column(double x) const { return 0.5 * size_.width + (x - view_.x) / metres_per_pixel_; }
  double height(double y) const { return 0.5 * size_.height + (y - view_.y) / metres_per_pixel_; }
  std::string textOf(double metres) const;

  View view_;
  PictureSize size_;
  double base_;
  double metres_per_pixel_;
  double step_;  // [m] between two ticks: 1, 2 or 5 times a power of ten; length of the bar
};
}  // namespace sigloc
