// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "check_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

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
    if (cell == nullptr || cell->state() == CellState::unknown) return kUnknown;
    if (isWall(cell->state())) return kWall;
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

constexpr int kLabelRadius = 13;  // [pixels]

/// A place on the picture with the numbers of the twins that it belongs to.
struct TwinLabel
{
  int column, row;
  std::string numbers;

  bool covers(int x, int y) const { return std::hypot(column - x, row - y) < 2 * kLabelRadius; }
};

/// Draws the worst twins, joined by lines. Those that share a place share a label.
std::vector<TwinLabel> drawTwins(RasterPicture& picture, const std::vector<Twins>& twins)
{
  std::vector<TwinLabel> labels;
  for (std::size_t k = 0; k < std::min(kDrawnTwins, twins.size()); ++k)
  {
    const auto a = picture.pixelOf({twins[k].a.x, twins[k].a.y});
    const auto b = picture.pixelOf({twins[k].b.x, twins[k].b.y});
    picture.image().line(a.first, a.second, b.first, b.second, kTwin, 1);
    for (const auto& end : {a, b})
    {
      const auto same =
          std::find_if(labels.begin(), labels.end(),
                       [&](const TwinLabel& label) { return label.covers(end.first, end.second); });
      if (same == labels.end())
      {
        labels.push_back({end.first, end.second, std::to_string(k + 1)});
      }
      else
      {
        same->numbers += "," + std::to_string(k + 1);
      }
    }
  }
  for (const TwinLabel& label : labels)
  {
    for (int radius = 0; radius < kLabelRadius; ++radius)
      picture.image().drawCircle(label.column, label.row, radius, TColor(255, 255, 255), 2);
    picture.image().drawCircle(label.column, label.row, kLabelRadius, kTwin, 2);
    picture.put(label.column - 5, label.row - 10, label.numbers, kTwin);
  }
  return labels;
}

/// Crosses the places where the robot is fooled.
void drawFooled(RasterPicture& picture, const MapCheck& check)
{
  for (const CheckedPlace& place : check.places)
  {
    if (place.fooled == 0) continue;
    const auto at = picture.pixelOf({place.pose.x, place.pose.y});
    drawCross(picture, at.first, at.second);
  }
}

/// Writes how far to drive, the longest ways first. A number that would touch another
/// one, or a label, is left out.
void writeDrives(RasterPicture& picture, const MapCheck& check,
                 const std::vector<TwinLabel>& labels)
{
  constexpr int kWidth = 32;  // [pixels] of a number
  constexpr int kHeight = 20;
  std::vector<const CheckedPlace*> places;
  for (const CheckedPlace& place : check.places)
  {
    if (place.drive) places.push_back(&place);
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const CheckedPlace* a, const CheckedPlace* b)
                   { return *a->drive > *b->drive; });
  std::vector<std::pair<int, int>> written;
  written.reserve(labels.size() + places.size());
  for (const TwinLabel& label : labels)
    written.emplace_back(label.column - kLabelRadius, label.row - kLabelRadius);
  for (const CheckedPlace* place : places)
  {
    auto at = picture.pixelOf({place->pose.x, place->pose.y});
    const bool covered =
        std::any_of(labels.begin(), labels.end(),
                    [&](const TwinLabel& label) { return label.covers(at.first, at.second); });
    at.first += covered ? 2 * kLabelRadius : -6;
    at.second -= 10;
    const bool touches = std::any_of(written.begin(), written.end(),
                                     [&](const std::pair<int, int>& other)
                                     {
                                       return std::abs(other.first - at.first) < kWidth &&
                                              std::abs(other.second - at.second) < kHeight;
                                     });
    if (touches) continue;
    written.push_back(at);
    picture.put(at.first, at.second, metresText(*place->drive), kText);
  }
}

void drawTexts(RasterPicture& picture, const std::string& title)
{
  picture.put(kMargin, 8, title, kText);
  picture.put(kMargin, 36, "one scan localizes:", kText);
  constexpr int kBar = kMargin + 260;
  constexpr int kBarLength = 300;
  picture.put(kBar - 40, 36, "0 %", kText);
  for (int k = 0; k < kBarLength; ++k)
  {
    picture.image().line(kBar + k, 36, kBar + k, 56, colorOf(k / (kBarLength - 1.0)), 1);
  }
  picture.put(kBar + kBarLength + 8, 36, "100 %", kText);
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
  const std::vector<TwinLabel> labels = drawTwins(picture, check.twins);
  drawFooled(picture, check);
  writeDrives(picture, check, labels);
  picture.drawAxes();
  drawTexts(picture, title);
  return std::move(picture.image());
}
}  // namespace sigloc
