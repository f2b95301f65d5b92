// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "check_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "metres_text.h"
#include "RasterPicture.h"

namespace sigloc
{
using mrpt::img::CImage;
using mrpt::img::TColor;
using mrpt::math::TPoint2D;

namespace
{
constexpr int kTop = 100;  // [pixels] for title and legend
constexpr int kMargin = 12;
constexpr std::size_t kDrawnTwins = 8;
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
PlanarBox boxOf(const MapCheck& check, const DenseField& field)
{
  constexpr double kAround = 4;  // [m]
  const RasterFrame& frame = field.frame;
  const double right = frame.origin.x + frame.width * frame.resolution;
  const double top = frame.origin.y + frame.height * frame.resolution;
  PlanarBox box{right, frame.origin.x, top, frame.origin.y};
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

/// What one scan does at the nearest place that was asked.
class PlaceColors
{
 public:
  PlaceColors(const MapCheck& check, const DenseField& field) : check_(check), field_(field)
  {
    const double spacing = std::sqrt(check.area / static_cast<double>(check.places.size()));
    farthest_ = std::max(1.0, 1.2 * spacing);
  }

  TColor at(const TPoint2D& place) const
  {
    const DenseCell* cell = cellAt(field_, place);
    if (cell == nullptr || cell->state == CellState::unknown) return kUnknown;
    if (isWall(cell->state)) return kWall;
    double nearest = farthest_;
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

 private:
  const MapCheck& check_;
  const DenseField& field_;
  double farthest_;  // [m] from a place that is coloured like it
};

void drawCross(RasterPicture& picture, int column, int row)
{
  constexpr int kArm = 6;
  picture.image().line(column - kArm, row - kArm, column + kArm, row + kArm, kFooled, 2);
  picture.image().line(column - kArm, row + kArm, column + kArm, row - kArm, kFooled, 2);
}

void drawTwins(RasterPicture& picture, const Twins& twins, std::size_t number)
{
  constexpr int kRadius = 13;
  const auto a = picture.pixelOf({twins.a.x, twins.a.y});
  const auto b = picture.pixelOf({twins.b.x, twins.b.y});
  picture.image().line(a.first, a.second, b.first, b.second, kTwin, 1);
  for (const auto& [column, row] : {a, b})
  {
    for (int radius = 0; radius < kRadius; ++radius)
      picture.image().drawCircle(column, row, radius, TColor(255, 255, 255), 2);
    picture.image().drawCircle(column, row, kRadius, kTwin, 2);
    picture.put(column - 5, row - 10, std::to_string(number), kTwin);
  }
}

void drawPlace(RasterPicture& picture, const CheckedPlace& place)
{
  const auto [column, row] = picture.pixelOf({place.pose.x, place.pose.y});
  if (place.fooled > 0) drawCross(picture, column, row);
  if (!place.drive) return;
  picture.put(column - 6, row - 10, metresText(*place.drive), kText);
}

void drawTexts(RasterPicture& picture, const std::string& title)
{
  picture.put(kMargin, 8, title, kText);
  picture.put(kMargin, 36, "one scan localizes:", kText);
  int column = kMargin + 200;
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
  {
    picture.image().filledRectangle(column, 36, column + 20, 56, colorOf(share));
    picture.put(column + 26, 36, fmt::format("{:.0f} %", 100 * share), kText);
    column += 90;
  }
  picture.put(kMargin, 64, "number: metres to drive", kText);
  picture.put(kMargin + 270, 64, "x fooled", kFooled);
  picture.put(kMargin + 370, 64, "white: not asked", kText);
  picture.put(kMargin + 560, 64, "1, 2, ...: worst twins", kTwin);
}
}  // namespace

CImage checkPicture(const MapCheck& check, const DenseField& field, const std::string& title)
{
  RasterPicture picture(boxOf(check, field), kTop);
  const PlaceColors colors(check, field);
  picture.paint([&](const TPoint2D& place) { return colors.at(place); });
  for (const CheckedPlace& place : check.places) drawPlace(picture, place);
  for (std::size_t k = 0; k < std::min(kDrawnTwins, check.twins.size()); ++k)
    drawTwins(picture, check.twins[k], k + 1);
  picture.drawAxes();
  drawTexts(picture, title);
  return std::move(picture.image());
}
}  // namespace sigloc
