// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pictures.h"

#include <algorithm>
#include <string_view>

namespace sigloc
{
namespace
{
using mrpt::img::TColorf;

constexpr double kTitleShare = 0.09;  // of a panel's height, kept free of the map
constexpr double kLegendShare = 0.05;
constexpr double kSideShare = 0.02;
constexpr double kCloseUpHeight = 30.0;  // [m]
constexpr double kLinePixels = 2.0;
constexpr double kMarkPixels = 9.0;
constexpr float kTextScale = 34.0F;  // [pixels of the super-sampled picture]

struct LegendEntry
{
  const char* text;
  TColorf color;
};

const std::vector<LegendEntry> kMapLegend = {
    {"wall", TColorf(0.12F, 0.31F, 0.63F)},
    {"circle", TColorf(0.43F, 0.47F, 0)},
    {"corner", TColorf(0, 0.55F, 0.51F)},
    {"wall end", TColorf(0.59F, 0.35F, 0.08F)},
};
const std::vector<LegendEntry> kStepLegend = {
    {"returns", TColorf(0.88F, 0.12F, 0.12F)},
    {"observed features", TColorf(1, 0.55F, 0)},
    {"hypotheses", TColorf(0.88F, 0, 0.59F)},
    {"chosen pose", TColorf(0, 0.59F, 0.24F)},
    {"truth", TColorf(0, 0, 0)},
};

void addText(mrpt::opengl::COpenGLViewport& viewport, double x, double y, const std::string& text,
             std::size_t index, const TColorf& color)
{
  mrpt::opengl::TFontParams font;
  font.vfont_name = "sans";
  font.vfont_scale = kTextScale;
  font.color = color;
  viewport.addTextMessage(x, y, text, index, font);
}

/// Copies a picture into a wider one of the same height, `column` pixels from the left.
void paste(const mrpt::img::CImage& from, mrpt::img::CImage& to, unsigned column)
{
  const std::size_t row_bytes = from.getWidth() * static_cast<std::size_t>(from.channelCount());
  for (unsigned row = 0; row < from.getHeight(); ++row)
  {
    std::copy_n(from.ptrLine<std::uint8_t>(row), row_bytes, to.ptr<std::uint8_t>(column, row));
  }
}

/// Frames a box within the part of the panel that text leaves free.
View frame(const PlanarBox& box, double width_to_height)
{
  const double free_height = 1 - kTitleShare - kLegendShare;
  const double free_width = (1 - 2 * kSideShare) * width_to_height;
  View view;
  view.height =
      std::max({(box.y_max - box.y_min) / free_height, (box.x_max - box.x_min) / free_width, 1.0});
  view.x = 0.5 * (box.x_min + box.x_max);
  view.y = 0.5 * (box.y_min + box.y_max) + 0.5 * (kTitleShare - kLegendShare) * view.height;
  return view;
}
}  // namespace

/// A scene with the map in it, drawn for one scale.
struct PictureMaker::Panel
{
  mrpt::opengl::COpenGLScene scene;
  mrpt::opengl::CSetOfObjects::Ptr step_objects;
  View view;
  double metres_per_pixel;

  Panel(const FeatureMap& map, const View& initial_view, unsigned panel_height, bool small_features)
      : view(initial_view), metres_per_pixel(initial_view.height / panel_height)
  {
    auto viewport = scene.getViewport();
    viewport->setCustomBackgroundColor(TColorf(0.87F, 0.87F, 0.87F));
    viewport->setViewportClipDistances(0.1F, 4 * static_cast<float>(view.height) + 100);
    MapDrawing drawing;
    drawing.line_width = kLinePixels * metres_per_pixel;
    drawing.small_features = small_features;
    scene.insert(drawMap(map, drawing));
  }

  void show(StepDrawing step)
  {
    if (step_objects) scene.removeObject(step_objects);
    step.line_width = kLinePixels * metres_per_pixel;
    step.min_mark_size = kMarkPixels * metres_per_pixel;
    step_objects = drawStep(step);
    scene.insert(step_objects);
  }

  void write(const std::vector<std::string>& title, const std::vector<LegendEntry>& legend)
  {
    auto viewport = scene.getViewport();
    std::size_t index = 0;
    constexpr double kFirstLine = 0.965;
    constexpr double kLineSpacing = 0.031;
    for (const std::string& line : title)
    {
      addText(*viewport, kSideShare, kFirstLine - kLineSpacing * static_cast<double>(index), line,
              index, TColorf(0, 0, 0));
      ++index;
    }
    double x = kSideShare;
    for (const LegendEntry& entry : legend)
    {
      addText(*viewport, x, 0.015, entry.text, index++, entry.color);
      constexpr double kCharacterShare = 0.0165;  // of the panel's width, about
      x += kCharacterShare * (static_cast<double>(std::string_view(entry.text).size()) + 2.5);
    }
  }
};

PictureMaker::PictureMaker(const FeatureMap& map, unsigned panel_width, unsigned panel_height)
    : renderer_(panel_width, panel_height)
{
  const View whole = frame(boundsOf(map), static_cast<double>(panel_width) / panel_height);
  overview_ = std::make_unique<Panel>(map, whole, panel_height, whole.height <= 2 * kCloseUpHeight);
  View near = whole;
  near.height = kCloseUpHeight;
  close_up_ = std::make_unique<Panel>(map, near, panel_height, true);
}

PictureMaker::~PictureMaker() = default;

mrpt::img::CImage PictureMaker::mapPicture(const std::vector<std::string>& title)
{
  overview_->write(title, kMapLegend);
  return renderer_.render(overview_->scene, overview_->view);
}

mrpt::img::CImage PictureMaker::stepPicture(const StepDrawing& step,
                                            const std::vector<std::string>& title)
{
  std::optional<mrpt::math::TPose2D> centre = step.truth;
  if (step.belief != nullptr && !step.belief->hypotheses.empty())
  {
    centre = step.belief->hypotheses.front().pose.mean;
  }
  if (centre)
  {
    close_up_->view.x = centre->x;
    close_up_->view.y = centre->y;
  }
  overview_->show(step);
  overview_->write(title, kStepLegend);
  close_up_->show(step);
  close_up_->write({}, kMapLegend);
  const mrpt::img::CImage left = renderer_.render(overview_->scene, overview_->view);
  const mrpt::img::CImage right = renderer_.render(close_up_->scene, close_up_->view);
  mrpt::img::CImage both(2 * renderer_.width(), renderer_.height(), mrpt::img::CH_RGB);
  paste(left, both, 0);
  paste(right, both, renderer_.width());
  return both;
}
}  // namespace sigloc
