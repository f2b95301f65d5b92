// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "picture_axes.h"

#include <fmt/core.h>

#include <cmath>

namespace sigloc
{
namespace
{
constexpr double kMostPixels = 200;  // between two ticks
constexpr int kTickPixels = 8;
constexpr double kBarHeight = 12;  // [pixels] above the lower edge
constexpr double kBarThickness = 4;
constexpr double kMargin = 24;
const mrpt::img::TColor kColor(90, 90, 90);

/// The width of a number [pixels], about.
double widthOf(const std::string& text)
{
  constexpr double kCharacterPixels = 8;
  return kCharacterPixels * static_cast<double>(text.size());
}

/// The largest of 1, 2 and 5 times a power of ten that is no more than `most`.
double roundStep(double most)
{
  const double power = std::pow(10, std::floor(std::log10(most)));
  for (const double factor : {5.0, 2.0})
  {
    if (factor * power <= most) return factor * power;
  }
  return power;
}
}  // namespace

PictureAxes::PictureAxes(const View& view, const PictureSize& size, double base)
    : view_(view),
      size_(size),
      base_(base),
      metres_per_pixel_(view.height / size.height),
      step_(roundStep(kMostPixels * metres_per_pixel_))
{
}

std::string PictureAxes::textOf(double metres) const
{
  return fmt::format("{:.{}f}", metres + 0.0, step_ < 1 ? 1 : 0);
}

void PictureAxes::write(const PutText& put) const
{
  const auto first = [&](double from) { return std::ceil(from / step_) * step_; };
  for (double x = first(view_.x - 0.5 * metres_per_pixel_ * size_.width);
       column(x) < size_.width - 4 * kMargin; x += step_)
  {
    const std::string text = textOf(std::abs(x) < 1e-9 ? 0 : x);
    if (column(x) > kMargin) put(column(x) - 0.5 * widthOf(text), base_ - 14, text);
  }
  for (double y = first(view_.y + (base_ + kMargin - 0.5 * size_.height) * metres_per_pixel_);
       height(y) < size_.height - kMargin; y += step_)
  {
    const std::string text = textOf(std::abs(y) < 1e-9 ? 0 : y);
    put(size_.width - 2 * kTickPixels - widthOf(text), height(y) - 5, text);
  }
  const double bar = step_ / metres_per_pixel_;
  put(size_.width - kMargin - bar, kBarHeight + kBarThickness + 4, textOf(step_) + " m");
}

void PictureAxes::draw(mrpt::img::CImage& picture) const
{
  const auto fill = [&](double left, double right, double low, double high)
  {
    const auto row = [&](double up)
    { return static_cast<int>(size_.height - 1 - std::lround(up)); };
    picture.filledRectangle(static_cast<int>(std::lround(left)), row(high),
                            static_cast<int>(std::lround(right)), row(low), kColor);
  };
  fill(0, size_.width - 1, base_, base_);
  const auto first = [&](double from) { return std::ceil(from / step_) * step_; };
  for (double x = first(view_.x - 0.5 * metres_per_pixel_ * size_.width); column(x) < size_.width;
       x += step_)
  {
    fill(column(x), column(x), base_, base_ + kTickPixels);
  }
  for (double y = first(view_.y + (base_ - 0.5 * size_.height) * metres_per_pixel_);
       height(y) < size_.height; y += step_)
  {
    fill(size_.width - 1 - kTickPixels, size_.width - 1, height(y), height(y));
  }
  const double bar = step_ / metres_per_pixel_;
  fill(size_.width - kMargin - bar, size_.width - kMargin, kBarHeight, kBarHeight + kBarThickness);
}
}  // namespace sigloc
