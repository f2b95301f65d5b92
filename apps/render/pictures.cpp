// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pictures.h"

#include <algorithm>
#include <string_view>

#include "picture_axes.h"

namespace sigloc
{
namespace
{
using mrpt::img::TColorf;

constexpr double kTitlePixels = 95;  // kept free of the map
constexpr double kLegendPixels = 92;
constexpr double kSidePixels = 18;
constexpr double kLinePitchPixels = 34;
constexpr double kCloseUpSide = 22.0;  // [m], the shorter side
constexpr double kLinePixels = 2.4;
constexpr double kMarkPixels = 10.0;
constexpr float kTextScale = 34.0F;  // [pixels of the super-sampled picture]
constexpr float kBannerScale = 64.0F;
constexpr float kAxisScale = 22.0F;
constexpr double kAxisPixels = 54;  // below the axis of a picture without a legend
constexpr std::size_t kFirstAxisText = 1000;
const TColorf kAxisColor(0.35F, 0.35F, 0.35F);
constexpr int kFramePixels = 8;  // of a close-up that nobody may take for an answer
constexpr const char* kBanner = "NOT LOCALIZED";
constexpr unsigned kGapPixels = 4;  // between overview and close-up
constexpr double kCharacterPixels = 15.5;  // width, about

constexpr double kSmallFeatureScale = 0.06;  // [m/pixel], corners and wall ends clutter above it

// Overview and close-up are side by side or, for a wide map, one above the other.
constexpr PictureSize kBesideSize{960, 1080};
constexpr PictureSize kAboveSize{1600, 640};
constexpr PictureSize kBelowSize{1600, 900};

struct LegendEntry
{
  const char* text;
  TColorf color;

  LegendEntry(const char* name, const mrpt::img::TColor& its_color) : text(name), color(its_color)
  {
  }
  LegendEntry(const char* name, FeatureType type) : LegendEntry(name, colorOf(type)) {}

  static mrpt::img::TColor colorOf(FeatureType type)
  {
    const auto& [red, green, blue] = traitsOf(type).color;
    return {red, green, blue};
  }
};
using Legend = std::vector<LegendEntry>;

const Legend kMapLegend = {
    {"wall", FeatureType::segment},
    {"circle", FeatureType::circle},
    {"corner", FeatureType::corner},
    {"wall end", FeatureType::wall_end},
};
/// In a tall map's picture both rows fill what the scale bar leaves: "unsure", "likely" and
/// "unlikely" are poses, too.
const Legend kStepLegend = {
    {"returns", Palette::kReturns},    {"features seen", Palette::kObserved},
    {"sure pose", Palette::kSurePose}, {"unsure", Palette::kUnsurePose},
    {"likely", Palette::kLikely},      {"unlikely", Palette::kUnlikely},
};
const Legend kComparisonLegend = {
    {"proposed", Palette::kProposed},   {"returns", Palette::kReturns},
    {"candidates", Palette::kUnlikely}, {"sure", Palette::kSurePose},
    {"unsure", Palette::kUnsurePose},
};

/// The legend with the truth where it is drawn. A text is replaced by index: the empty one takes
/// the place of an earlier picture's.
Legend withTruth(Legend legend, const StepDrawing& step)
{
  legend.emplace_back(step.truth ? "truth" : "", Palette::kTruth);
  return legend;
}

Legend stepMapLegend()
{
  Legend legend = kMapLegend;
  legend.emplace_back("path", Palette::kPath);
  return legend;
}

void addText(mrpt::opengl::COpenGLViewport& viewport, double x, double y, const std::string& text,
             std::size_t index, const TColorf& color, float scale = kTextScale)
{
  mrpt::opengl::TFontParams font;
  font.vfont_name = "sans";
  font.vfont_scale = scale;
  font.color = color;
  viewport.addTextMessage(x, y, text, index, font);
}

void addFrame(mrpt::img::CImage& picture)
{
  const auto width = static_cast<int>(picture.getWidth());
  const auto height = static_cast<int>(picture.getHeight());
  const mrpt::img::TColor& color = Palette::kNotLocalized;
  picture.filledRectangle(0, 0, width - 1, kFramePixels, color);
  picture.filledRectangle(0, height - kFramePixels, width - 1, height - 1, color);
  picture.filledRectangle(0, 0, kFramePixels, height - 1, color);
  picture.filledRectangle(width - kFramePixels, 0, width - 1, height - 1, color);
}

/// Copies a picture into a larger one, its upper left corner at (column, row).
void paste(const mrpt::img::CImage& from, mrpt::img::CImage& to, unsigned column, unsigned row_0)
{
  const std::size_t row_bytes = from.getWidth() * static_cast<std::size_t>(from.channelCount());
  for (unsigned row = 0; row < from.getHeight(); ++row)
  {
    std::copy_n(from.ptrLine<std::uint8_t>(row), row_bytes,
                to.ptr<std::uint8_t>(column, row_0 + row));
  }
}

bool isWide(const PlanarBox& box)
{
  return box.x_max - box.x_min > 1.6 * (box.y_max - box.y_min);
}

/// Frames a box within the part of the picture that text leaves free.
View frame(const PlanarBox& box, const PictureSize& size)
{
  const double free_height = size.height - kTitlePixels - kLegendPixels;
  const double free_width = size.width - 2 * kSidePixels;
  const double metres_per_pixel =
      std::max({(box.y_max - box.y_min) / free_height, (box.x_max - box.x_min) / free_width, 1e-3});
  View view;
  view.height = metres_per_pixel * size.height;
  view.x = 0.5 * (box.x_min + box.x_max);
  view.y = 0.5 * (box.y_min + box.y_max) + 0.5 * (kTitlePixels - kLegendPixels) * metres_per_pixel;
  return view;
}
}  // namespace

/// A scene with the map in it, drawn for one scale.
struct PictureMaker::Panel
{
  mrpt::opengl::COpenGLScene scene;
  mrpt::opengl::CSetOfObjects::Ptr step_objects;
  View view;
  PictureSize size;
  double metres_per_pixel;
  bool small_features;
  double axis = kAxisPixels;

  Panel(const FeatureMap& map, const View& initial_view, const PictureSize& panel_size)
      : view(initial_view),
        size(panel_size),
        metres_per_pixel(initial_view.height / panel_size.height),
        small_features(metres_per_pixel <= kSmallFeatureScale)
  {
    auto viewport = scene.getViewport();
    viewport->setCustomBackgroundColor(TColorf(0.87F, 0.87F, 0.87F));
    const double widest = std::max(view.height, view.height * size.width / size.height);
    viewport->setViewportClipDistances(0.1F, static_cast<float>(4 * widest + 100));
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

  /// Renders the scene with its axes.
  mrpt::img::CImage picture(OffscreenRenderer& renderer)
  {
    const PictureAxes axes(view, size, axis);
    auto viewport = scene.getViewport();
    std::size_t index = kFirstAxisText;
    const auto put = [&](double x, double y, const std::string& text)
    {
      if (index < kFirstAxisText + PictureAxes::kMostTexts)
        addText(*viewport, x / size.width, y / size.height, text, index++, kAxisColor, kAxisScale);
    };
    axes.write(put);
    while (index < kFirstAxisText + PictureAxes::kMostTexts) put(0, 0, "");  // of another view
    mrpt::img::CImage image = renderer.render(scene, view, size);
    axes.draw(image);
    return image;
  }

  void writeBanner(const std::string& text)
  {
    const double y = 1 - 2 * kLinePitchPixels / size.height;
    addText(*scene.getViewport(), kSidePixels / size.width, y, text, 0,
            TColorf(Palette::kNotLocalized), kBannerScale);
  }

  void write(const std::vector<std::string>& title, const std::vector<Legend>& legend)
  {
    if (!legend.empty()) axis = kLegendPixels;
    auto viewport = scene.getViewport();
    std::size_t index = 0;
    for (const std::string& line : title)
    {
      const double y = 1 - kLinePitchPixels * static_cast<double>(index + 1) / size.height;
      addText(*viewport, kSidePixels / size.width, y, line, index, TColorf(0, 0, 0));
      ++index;
    }
    for (std::size_t row = 0; row < legend.size(); ++row)
    {
      const double y = (0.2 * kLegendPixels + kLinePitchPixels * static_cast<double>(row));
      double x = kSidePixels;
      for (const LegendEntry& entry : legend[row])
      {
        addText(*viewport, x / size.width, y / size.height, entry.text, index++, entry.color);
        const auto characters = static_cast<double>(std::string_view(entry.text).size());
        x += kCharacterPixels * (characters + 2);
      }
    }
  }
};

PictureMaker::PictureMaker(const FeatureMap& map)
{
  const PlanarBox box = boundsOf(map);
  const PictureSize overview_size = isWide(box) ? kAboveSize : kBesideSize;
  const PictureSize close_up_size = isWide(box) ? kBelowSize : kBesideSize;
  const View whole = frame(box, overview_size);
  overview_ = std::make_unique<Panel>(map, whole, overview_size);
  View near = whole;
  near.height =
      kCloseUpSide * std::max(1.0, static_cast<double>(close_up_size.height) / close_up_size.width);
  close_up_ = std::make_unique<Panel>(map, near, close_up_size);
}

PictureMaker::~PictureMaker() = default;

mrpt::img::CImage PictureMaker::mapPicture(const std::vector<std::string>& title)
{
  overview_->write(title, {kMapLegend});
  return picture(*overview_);
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
  overview_->write(title, {withTruth(stepMapLegend(), step), kStepLegend});
  close_up_->show(step);
  const bool sure = step.belief != nullptr && step.belief->verdict == Verdict::localized;
  close_up_->writeBanner(sure ? "" : kBanner);
  mrpt::img::CImage near = picture(*close_up_);
  if (!sure) addFrame(near);
  return join({picture(*overview_), near});
}

mrpt::img::CImage PictureMaker::comparison(const StepDrawing& step,
                                           const std::vector<std::string>& title,
                                           const std::vector<CloseUp>& places)
{
  StepDrawing whole = step;
  whole.observed = nullptr;
  overview_->show(whole);
  overview_->write(title, {kMapLegend, withTruth(kComparisonLegend, step)});
  std::vector<mrpt::img::CImage> pictures = {picture(*overview_)};
  for (const CloseUp& place : places)
  {
    StepDrawing near = step;
    near.observed_at = place.scan_at;
    close_up_->view.x = place.scan_at.x;
    close_up_->view.y = place.scan_at.y;
    close_up_->show(near);
    close_up_->write({place.title}, {});
    pictures.push_back(picture(*close_up_));
  }
  return join(pictures);
}

mrpt::img::CImage PictureMaker::picture(Panel& panel)
{
  return panel.picture(renderer_);
}

/// Side by side, or one above the other for a wide map.
mrpt::img::CImage PictureMaker::join(const std::vector<mrpt::img::CImage>& pictures) const
{
  const bool stacked = overview_->size.width == kAboveSize.width;
  unsigned width = 0;
  unsigned height = 0;
  for (const mrpt::img::CImage& each : pictures)
  {
    const auto w = static_cast<unsigned>(each.getWidth());
    const auto h = static_cast<unsigned>(each.getHeight());
    const unsigned gap = width == 0 ? 0 : kGapPixels;
    width = stacked ? std::max(width, w) : width + gap + w;
    height = stacked ? height + gap + h : std::max(height, h);
  }
  mrpt::img::CImage all(width, height, mrpt::img::CH_RGB);
  all.filledRectangle(0, 0, static_cast<int>(width) - 1, static_cast<int>(height) - 1,
                      mrpt::img::TColor(70, 70, 70));
  unsigned at = 0;
  for (const mrpt::img::CImage& each : pictures)
  {
    paste(each, all, stacked ? 0 : at, stacked ? at : 0);
    at += static_cast<unsigned>(stacked ? each.getHeight() : each.getWidth()) + kGapPixels;
  }
  return all;
}
}  // namespace sigloc
