// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "check_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "picture_axes.h"

namespace sigloc
{
using mrpt::img::CImage;
using mrpt::img::TColor;
using mrpt::math::TPoint2D;

namespace
{
constexpr double kLongSide = 1500;  // [pixels] of the map
constexpr int kTop = 100;  // [pixels] for title and legend
constexpr int kBottom = 60;  // for the axis
constexpr int kMargin = 12;
constexpr int kLeastWidth = 900;
constexpr std::size_t kDrawnTwins = 8;
constexpr const char* kFont = "10x20";
const TColor kUnknown(205, 205, 205);
const TColor kWall(40, 40, 40);
const TColor kTwin(30, 70, 200);
const TColor kFooled(200, 0, 160);
const TColor kText(20, 20, 20);

struct Stop
{
  double share;
  TColor color;
};
/// From never localized by one scan to always.
const std::array<Stop, 4> kScale = {{{0.0, TColor(222, 84, 60)},
                                     {0.5, TColor(246, 196, 84)},
                                     {0.8, TColor(190, 222, 120)},
                                     {1.0, TColor(90, 186, 110)}}};

TColor colorOf(double share)
{
  std::size_t k = 1;
  while (k + 1 < kScale.size() && kScale[k].share < share) ++k;
  const Stop& low = kScale[k - 1];
  const Stop& high = kScale[k];
  const double t = std::clamp((share - low.share) / (high.share - low.share), 0.0, 1.0);
  const auto mix = [&](std::uint8_t a, std::uint8_t b)
  { return static_cast<std::uint8_t>(std::lround(a + t * (b - a))); };
  return {mix(low.color.R, high.color.R), mix(low.color.G, high.color.G),
          mix(low.color.B, high.color.B)};
}

/// The box of the places with a margin: what the rest of a raster holds is of no interest.
struct Box
{
  double x_min, x_max, y_min, y_max;
};

Box boxOf(const MapCheck& check, const DenseField& field)
{
  constexpr double kAround = 4;  // [m]
  const RasterFrame& frame = field.frame;
  const double right = frame.origin.x + frame.width * frame.resolution;
  const double top = frame.origin.y + frame.height * frame.resolution;
  Box box{right, frame.origin.x, top, frame.origin.y};
  const auto include = [&](double x, double y)
  {
    box.x_min = std::max(std::min(box.x_min, x - kAround), frame.origin.x);
    box.x_max = std::min(std::max(box.x_max, x + kAround), right);
    box.y_min = std::max(std::min(box.y_min, y - kAround), frame.origin.y);
    box.y_max = std::min(std::max(box.y_max, y + kAround), top);
  };
  for (const CheckedPlace& place : check.places) include(place.pose.x, place.pose.y);
  return box;
}

class CheckPicture
{
 public:
  CheckPicture(const MapCheck& check, const DenseField& field)
      : check_(check), field_(field), box_(boxOf(check, field))
  {
    const double width = box_.x_max - box_.x_min;
    const double height = box_.y_max - box_.y_min;
    metres_per_pixel_ = std::max(width, height) / kLongSide;
    size_.width =
        static_cast<unsigned>(std::max<double>(kLeastWidth, std::ceil(width / metres_per_pixel_)));
    map_height_ = static_cast<int>(std::ceil(height / metres_per_pixel_));
    size_.height = static_cast<unsigned>(map_height_ + kTop + kBottom);
    image_ = CImage(size_.width, size_.height, mrpt::img::CH_RGB);
    image_.filledRectangle(0, 0, static_cast<int>(size_.width) - 1,
                           static_cast<int>(size_.height) - 1, TColor(255, 255, 255));
  }

  void drawMap()
  {
    for (int row = kTop; row < kTop + map_height_; ++row)
    {
      for (int column = 0; column < static_cast<int>(size_.width); ++column)
        image_.setPixel(column, row, static_cast<std::size_t>(colorAt(placeAt(column, row))));
    }
  }

  void drawMarks()
  {
    for (const CheckedPlace& place : check_.places)
    {
      const auto [column, row] = pixelOf(place.pose.x, place.pose.y);
      if (place.fooled > 0) cross(column, row);
      if (!place.drive) continue;
      const std::string metres =
          std::isfinite(*place.drive) ? fmt::format("{:.0f}", *place.drive) : ">20";
      image_.textOut(column - 6, row - 10, metres, kText);
    }
    for (std::size_t k = 0; k < std::min(kDrawnTwins, check_.twins.size()); ++k) drawTwins(k);
  }

  void drawTexts(const std::string& title)
  {
    const PictureAxes axes(view(), size_, kBottom - 4);
    axes.write([&](double x, double y, const std::string& text)
               { put(static_cast<int>(x), static_cast<int>(size_.height - y) - 14, text, kText); });
    axes.draw(image_);
    put(kMargin, 8, title, kText);
    put(kMargin, 36, "one scan localizes:", kText);
    int column = kMargin + 200;
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
    {
      image_.filledRectangle(column, 36, column + 20, 56, colorOf(share));
      put(column + 26, 36, fmt::format("{:.0f} %", 100 * share), kText);
      column += 90;
    }
    put(kMargin, 64, "number: metres to drive", kText);
    put(kMargin + 270, 64, "x fooled", kFooled);
    put(kMargin + 370, 64, "white: not asked", kText);
    put(kMargin + 560, 64, "1, 2, ...: worst twins", kTwin);
  }

  CImage take() { return std::move(image_); }

 private:
  TPoint2D placeAt(int column, int row) const
  {
    return {box_.x_min + (column + 0.5) * metres_per_pixel_,
            box_.y_max - (row - kTop + 0.5) * metres_per_pixel_};
  }

  std::pair<int, int> pixelOf(double x, double y) const
  {
    return {static_cast<int>(std::lround((x - box_.x_min) / metres_per_pixel_)),
            kTop + static_cast<int>(std::lround((box_.y_max - y) / metres_per_pixel_))};
  }

  View view() const
  {
    View view;
    view.height = metres_per_pixel_ * size_.height;
    view.x = box_.x_min + 0.5 * metres_per_pixel_ * size_.width;
    view.y = box_.y_max + kTop * metres_per_pixel_ - 0.5 * view.height;
    return view;
  }

  TColor colorAt(const TPoint2D& place) const
  {
    const DenseCell* cell = cellAt(field_, place);
    if (cell == nullptr || cell->state == CellState::unknown) return kUnknown;
    if (isWall(cell->state)) return kWall;
    const double spacing = std::sqrt(check_.area / static_cast<double>(check_.places.size()));
    double nearest = std::max(1.0, 1.2 * spacing);
    TColor color(255, 255, 255);
    for (const CheckedPlace& checked : check_.places)
    {
      const double off = std::hypot(checked.pose.x - place.x, checked.pose.y - place.y);
      if (off >= nearest) continue;
      nearest = off;
      color = colorOf(checked.localizedShare());
    }
    return color;
  }

  void put(int column, int row, const std::string& text, const TColor& color)
  {
    image_.selectTextFont(kFont);
    image_.textOut(column, row, text, color);
  }

  void cross(int column, int row)
  {
    constexpr int kArm = 6;
    image_.line(column - kArm, row - kArm, column + kArm, row + kArm, kFooled, 2);
    image_.line(column - kArm, row + kArm, column + kArm, row - kArm, kFooled, 2);
  }

  void drawTwins(std::size_t k)
  {
    constexpr int kRadius = 13;
    const Twins& twins = check_.twins[k];
    const auto a = pixelOf(twins.a.x, twins.a.y);
    const auto b = pixelOf(twins.b.x, twins.b.y);
    image_.line(a.first, a.second, b.first, b.second, kTwin, 1);
    for (const auto& [column, row] : {a, b})
    {
      for (int radius = 0; radius < kRadius; ++radius)
        image_.drawCircle(column, row, radius, TColor(255, 255, 255), 2);
      image_.drawCircle(column, row, kRadius, kTwin, 2);
      put(column - 5, row - 10, std::to_string(k + 1), kTwin);
    }
  }

  const MapCheck& check_;
  const DenseField& field_;
  Box box_;
  double metres_per_pixel_ = 1;
  PictureSize size_;
  int map_height_ = 0;
  CImage image_;
};
}  // namespace

CImage checkPicture(const MapCheck& check, const DenseField& field, const std::string& title)
{
  CheckPicture picture(check, field);
  picture.drawMap();
  picture.drawMarks();
  picture.drawTexts(title);
  return picture.take();
}
}  // namespace sigloc
