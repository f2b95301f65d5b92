// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/plugin/map_drawing.h"

#include <mrpt/opengl/CTexturedPlane.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <Eigen/Eigenvalues>

#include "map/field_tiles.h"
#include "plugin/TriangleBatch.h"

namespace sigloc
{
namespace
{
using detail::TriangleBatch;
using mrpt::img::TColor;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

// From below to above; the distances only order the layers, seen from straight above.
constexpr double kFloorHeight = 0.0;
constexpr double kMapHeight = 0.1;
constexpr double kPathHeight = 0.2;
constexpr double kScanHeight = 0.3;
constexpr double kBeliefHeight = 0.4;
constexpr double kPoseHeight = 0.5;
constexpr double kTruthHeight = 0.6;

constexpr std::uint32_t kMaxTextureSide = 2048;

TPoint2D unitVector(double angle)
{
  return {std::cos(angle), std::sin(angle)};
}

std::uint8_t greyOf(CellState state)
{
  switch (state)
  {
    case CellState::free:
      return Palette::kFreeShade;
    case CellState::wall:
    case CellState::solid_wall:
      return Palette::kWallShade;
    case CellState::unknown:
      break;
  }
  return Palette::kUnknownShade;
}

/// The raster as a picture. Where the raster is large, blocks of cells shrink to one pixel. A block
/// with a wall in it stays a wall, so that thin walls are kept.
mrpt::opengl::CTexturedPlane::Ptr drawRaster(const DenseField& field)
{
  const RasterFrame& frame = field.frame;
  const std::uint32_t block =
      std::max(1U, (std::max(frame.width, frame.height) + kMaxTextureSide - 1) / kMaxTextureSide);
  const ShrunkField shrunk = shrunkField(field, block);
  const auto& [width, height, states] = shrunk;
  mrpt::img::CImage image(width, height, mrpt::img::CH_RGB);
  for (std::uint32_t v = 0; v < height; ++v)
  {
    for (std::uint32_t u = 0; u < width; ++u)
    {
      // CTexturedPlane draws its texture's first row at the lowest y.
      auto* pixel = image.ptr<std::uint8_t>(u, v);
      std::fill(pixel, pixel + 3, greyOf(states[std::size_t{v} * width + u]));
    }
  }
  auto plane = mrpt::opengl::CTexturedPlane::Create();
  plane->setPlaneCorners(static_cast<float>(frame.origin.x),
                         static_cast<float>(frame.origin.x + frame.resolution * width * block),
                         static_cast<float>(frame.origin.y),
                         static_cast<float>(frame.origin.y + frame.resolution * height * block));
  plane->assignImage(std::move(image));
  plane->CRenderizableShaderTexturedTriangles::enableLight(false);
  plane->CRenderizableShaderTriangles::enableLight(false);
  return plane;
}

void addCorner(TriangleBatch& batch, const Feature& corner, double leg, double width,
               const TColor& color)
{
  for (const double side : {-0.5, 0.5})
  {
    const TPoint2D arm = unitVector(corner.direction + side * corner.size) * leg;
    batch.addLine(corner.position, corner.position + arm, width, color);
  }
}

/// Adds a feature given in the frame of the picture.
void addFeature(TriangleBatch& batch, const Feature& feature, double width, bool small_features,
                const std::optional<TColor>& one_color)
{
  const auto& [red, green, blue] = traitsOf(feature.type).color;
  const TColor color = one_color.value_or(TColor(red, green, blue));
  if (isSegment(feature.type))
  {
    batch.addLine(segmentStart(feature), segmentEnd(feature), width, color);
  }
  else if (isRound(feature.type))
  {
    batch.addRing(feature.position, std::max(feature.size, 0.7 * width), 0.7 * width, color);
  }
  else if (small_features && traitsOf(feature.type).size == FeatureSize::opening)
  {
    addCorner(batch, feature, 4 * width, width, color);
  }
  else if (small_features)
  {
    batch.addDisc(feature.position, hasBearing(feature.type) ? 1.2 * width : width, color);
  }
}

/// Light blue for a weight of zero, magenta for one.
TColor weightColor(double weight)
{
  const double w = std::sqrt(std::clamp(weight, 0.0, 1.0));  // small weights remain visible
  const auto mix = [w](double from, double to)
  { return static_cast<std::uint8_t>(std::lround(from + w * (to - from))); };
  const TColor& from = Palette::kUnlikely;
  const TColor& to = Palette::kLikely;
  return {mix(from.R, to.R), mix(from.G, to.G), mix(from.B, to.B)};
}

/// Outline of the 3-sigma ellipse of the position, no semi-axis below `min_axis` [m].
std::vector<TPoint2D> ellipseOf(const GaussianPose& pose, double min_axis)
{
  Eigen::Matrix2d covariance;
  covariance << pose.covariance(0, 0), pose.covariance(0, 1), pose.covariance(0, 1),
      pose.covariance(1, 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(covariance);
  const auto axis = [&](int i)
  { return std::max(min_axis, 3 * std::sqrt(std::max(0.0, eigen.eigenvalues()[i]))); };
  const Eigen::Vector2d a = eigen.eigenvectors().col(0) * axis(0);
  const Eigen::Vector2d b = eigen.eigenvectors().col(1) * axis(1);
  std::vector<TPoint2D> outline;
  constexpr int kPoints = 48;
  for (int i = 0; i < kPoints; ++i)
  {
    const double t = 2 * M_PI * i / kPoints;
    const Eigen::Vector2d p = a * std::cos(t) + b * std::sin(t);
    outline.emplace_back(pose.mean.x + p.x(), pose.mean.y + p.y());
  }
  return outline;
}

mrpt::opengl::CSetOfObjects::Ptr drawBelief(const Belief& belief, const StepDrawing& step)
{
  TriangleBatch batch(kBeliefHeight);
  // Heaviest last, so that it lies on top.
  for (auto it = belief.hypotheses.rbegin(); it != belief.hypotheses.rend(); ++it)
  {
    const TPose2D& mean = it->pose.mean;
    const TColor color = weightColor(it->weight);
    batch.addPolyline(ellipseOf(it->pose, step.min_mark_size), 1.5 * step.line_width, true, color);
    const TPoint2D centre(mean.x, mean.y);
    batch.addLine(centre, centre + unitVector(mean.phi) * (2 * step.min_mark_size),
                  1.5 * step.line_width, color);
  }
  return batch.object();
}

void addReturns(TriangleBatch& batch, const ObservedScene& observed, const TPose2D& map_from_robot,
                double width)
{
  for (const BeamEnd& beam : observed.beams)
  {
    batch.addSquare(map_from_robot.composePoint(beam.point), 1.2 * width, Palette::kReturns);
  }
}

mrpt::opengl::CSetOfObjects::Ptr drawScan(const ObservedScene& observed,
                                          const TPose2D& map_from_robot, double width)
{
  TriangleBatch batch(kScanHeight);
  for (const Feature& feature : observed.features)
  {
    addFeature(batch, transformed(map_from_robot, feature), 1.4 * width, false, Palette::kObserved);
  }
  addReturns(batch, observed, map_from_robot, width);
  return batch.object();
}

/// Pale squares of 10 m below all that is seen within 100 m.
mrpt::opengl::CSetOfObjects::Ptr drawFloor(const ObservedScene& seen)
{
  constexpr double kSide = 10.0;  // [m]
  constexpr double kFarthest = 100.0;  // [m]
  constexpr double kRim = 1.0;  // [m]
  TPoint2D low(0, 0);
  TPoint2D high(0, 0);
  const auto include = [&](const TPoint2D& point)
  {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  };
  for (const BeamEnd& beam : seen.beams) include(beam.point);
  for (const Feature& feature : seen.features) include(feature.position);
  const auto cell = [&](double at)
  { return static_cast<int>(std::floor(std::clamp(at, -kFarthest, kFarthest) / kSide)); };
  const TColor color(Palette::kUnknownShade, Palette::kUnknownShade, Palette::kUnknownShade);
  TriangleBatch batch(kFloorHeight);
  for (int x = cell(low.x - kRim); x <= cell(high.x + kRim); ++x)
  {
    for (int y = cell(low.y - kRim); y <= cell(high.y + kRim); ++y)
    {
      batch.addSquare({kSide * (x + 0.5), kSide * (y + 0.5)}, kSide, color);
    }
  }
  return batch.object();
}

mrpt::opengl::CSetOfObjects::Ptr drawRobot(const TPose2D& pose, double size, const TColor& color)
{
  TriangleBatch batch(kPoseHeight);
  const TPoint2D centre(pose.x, pose.y);
  const auto corner = [&](double angle, double radius)
  { return centre + unitVector(pose.phi + angle) * radius; };
  const TPoint2D tip = corner(0, 1.6 * size);
  const TPoint2D notch = corner(M_PI, 0.4 * size);
  batch.addTriangle(tip, corner(2.5, size), notch, color);
  batch.addTriangle(tip, notch, corner(-2.5, size), color);
  return batch.object();
}

mrpt::opengl::CSetOfObjects::Ptr drawTruth(const TPose2D& truth, double size, double width)
{
  TriangleBatch batch(kTruthHeight);
  const TPoint2D centre(truth.x, truth.y);
  batch.addRing(centre, 2 * size, 1.2 * width, Palette::kTruth);
  batch.addLine(centre + unitVector(truth.phi) * (2 * size),
                centre + unitVector(truth.phi) * (3.2 * size), 1.2 * width, Palette::kTruth);
  return batch.object();
}

mrpt::opengl::CSetOfObjects::Ptr drawPath(const std::vector<TPose2D>& path, double width)
{
  TriangleBatch batch(kPathHeight);
  // The estimate jumps while the robot is lost. A line across the map would look like a path.
  constexpr double kMaxLeg = 2.0;  // [m]
  for (std::size_t i = 1; i < path.size(); ++i)
  {
    const TPoint2D a(path[i - 1].x, path[i - 1].y);
    const TPoint2D b(path[i].x, path[i].y);
    if (std::hypot(b.x - a.x, b.y - a.y) <= kMaxLeg) batch.addLine(a, b, width, Palette::kPath);
  }
  return batch.object();
}
mrpt::opengl::CSetOfObjects::Ptr drawProposed(const std::vector<TPose2D>& poses, double width)
{
  TriangleBatch batch(kPathHeight);
  for (const TPose2D& pose : poses)
  {
    batch.addSquare({pose.x, pose.y}, 1.2 * width, Palette::kProposed);
  }
  return batch.object();
}
}  // namespace

mrpt::opengl::CSetOfObjects::Ptr drawMap(const FeatureMap& map, const MapDrawing& drawing)
{
  auto objects = mrpt::opengl::CSetOfObjects::Create();
  if (drawing.raster && map.field()) objects->insert(drawRaster(*map.field()));
  TriangleBatch batch(kMapHeight);
  for (const Feature& feature : map.features())
  {
    addFeature(batch, feature, drawing.line_width, drawing.small_features, std::nullopt);
  }
  objects->insert(batch.object());
  return objects;
}

mrpt::opengl::CSetOfObjects::Ptr drawStep(const StepDrawing& step)
{
  auto objects = mrpt::opengl::CSetOfObjects::Create();
  objects->insert(drawProposed(step.proposed, step.line_width));
  objects->insert(drawPath(step.path, step.line_width));
  std::optional<TPose2D> observed_at = step.observed_at;
  if (step.belief != nullptr && !step.belief->hypotheses.empty())
  {
    const TPose2D& first = step.belief->hypotheses.front().pose.mean;
    if (!observed_at) observed_at = first;
    objects->insert(drawBelief(*step.belief, step));
    const bool sure = step.belief->verdict == Verdict::localized;
    objects->insert(
        drawRobot(first, step.min_mark_size, sure ? Palette::kSurePose : Palette::kUnsurePose));
  }
  if (step.observed != nullptr && observed_at)
  {
    objects->insert(drawScan(*step.observed, *observed_at, step.line_width));
  }
  if (step.truth) objects->insert(drawTruth(*step.truth, step.min_mark_size, step.line_width));
  return objects;
}

mrpt::opengl::CSetOfObjects::Ptr drawObservation(const ObservedScene& seen, double line_width)
{
  constexpr double kRobotSize = 0.3;  // [m]
  constexpr float kFlatter = 0.2F;  // looked at aslant, high layers would not lie over each other
  auto objects = mrpt::opengl::CSetOfObjects::Create();
  objects->insert(drawFloor(seen));
  TriangleBatch returns(kScanHeight);
  addReturns(returns, seen, TPose2D(0, 0, 0), line_width);
  objects->insert(returns.object());
  TriangleBatch features(kBeliefHeight);
  for (const Feature& feature : seen.features)
  {
    addFeature(features, feature, line_width, true, std::nullopt);
  }
  objects->insert(features.object());
  objects->insert(drawRobot(TPose2D(0, 0, 0), kRobotSize, Palette::kSurePose));
  objects->setScale(1, 1, kFlatter);
  return objects;
}

PlanarBox boundsOf(const FeatureMap& map)
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  PlanarBox box{kInfinity, -kInfinity, kInfinity, -kInfinity};
  const auto include = [&box](double x, double y)
  {
    box = {std::min(box.x_min, x), std::max(box.x_max, x), std::min(box.y_min, y),
           std::max(box.y_max, y)};
  };
  for (const Feature& feature : map.features())
  {
    include(feature.position.x, feature.position.y);
    if (isPointLike(feature.type)) continue;
    for (const TPoint2D& end : {segmentStart(feature), segmentEnd(feature)}) include(end.x, end.y);
  }
  if (map.field())
  {
    const RasterFrame& frame = map.field()->frame;
    for (const StoredCells& stored : storedCells(*map.field()))
    {
      for (std::uint32_t y = 0; y < stored.height; ++y)
      {
        const auto known = [](const DenseCell& cell) { return cell.state() != CellState::unknown; };
        const DenseCell* const row = stored.row(y);
        const DenseCell* const end = row + stored.width;
        const DenseCell* const first = std::find_if(row, end, known);
        if (first == end) continue;
        const auto last =
            std::find_if(std::make_reverse_iterator(end), std::make_reverse_iterator(row), known);
        for (const DenseCell* cell : {first, &*last})
        {
          const auto x = static_cast<std::uint32_t>(cell - row);
          include(frame.origin.x + frame.resolution * (stored.x + x + 0.5),
                  frame.origin.y + frame.resolution * (stored.y + y + 0.5));
        }
      }
    }
  }
  return box.x_min <= box.x_max ? box : PlanarBox{0, 1, 0, 1};
}
}  // namespace sigloc
