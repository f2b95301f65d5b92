// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "alignment_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "RasterPicture.h"

namespace sigloc
{
using mrpt::img::TColor;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr int kTop = 80;  // [pixels] for the title
constexpr int kMargin = 12;
const TColor kText(20, 20, 20);
const TColor kWallOfA(150, 150, 150);
const TColor kWallOfB(215, 30, 30);
const TColor kUnknown(222, 222, 222);
const TColor kFree(255, 255, 255);
const TColor kOutline(30, 70, 200);

std::array<TPoint2D, 4> cornersOf(const DenseField& field)
{
  const RasterFrame& frame = field.frame;
  const double x = frame.origin.x + frame.width * frame.resolution;
  const double y = frame.origin.y + frame.height * frame.resolution;
  return {TPoint2D(frame.origin.x, frame.origin.y), TPoint2D(x, frame.origin.y), TPoint2D(x, y),
          TPoint2D(frame.origin.x, y)};
}

PlanarBox boxOf(const DenseField& a, const DenseField& b, const std::vector<MapPose>& poses)
{
  std::vector<TPoint2D> corners;
  for (const TPoint2D& corner : cornersOf(a)) corners.push_back(corner);
  for (const MapPose& pose : poses)
  {
    for (const TPoint2D& corner : cornersOf(b))
      corners.push_back(pose.a_from_b.mean.composePoint(corner));
  }
  PlanarBox box{corners[0].x, corners[0].x, corners[0].y, corners[0].y};
  for (const TPoint2D& corner : corners)
  {
    box.x_min = std::min(box.x_min, corner.x);
    box.x_max = std::max(box.x_max, corner.x);
    box.y_min = std::min(box.y_min, corner.y);
    box.y_max = std::max(box.y_max, corner.y);
  }
  return box;
}

bool hasWall(const DenseField& field, const TPoint2D& place)
{
  const DenseCell* cell = cellAt(field, place);
  return cell != nullptr && isWall(cell->state());
}

void drawOutline(RasterPicture& picture, const DenseField& b, const TPose2D& pose,
                 const std::string& label)
{
  const auto corners = cornersOf(b);
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const auto from = picture.pixelOf(pose.composePoint(corners[k]));
    const auto to = picture.pixelOf(pose.composePoint(corners[(k + 1) % corners.size()]));
    picture.image().line(from.first, from.second, to.first, to.second, kOutline, 1);
    if (k == 0) picture.put(from.first + 4, from.second - 22, label, kOutline);
  }
}
}  // namespace

mrpt::img::CImage alignmentPicture(const DenseField& a, const DenseField& b,
                                   const std::vector<MapPose>& poses, const std::string& title)
{
  RasterPicture picture(boxOf(a, b, poses), kTop);
  const TPose2D b_from_a = TPose2D(0, 0, 0) - poses.front().a_from_b.mean;
  picture.paint(
      [&](const TPoint2D& place)
      {
        if (hasWall(b, b_from_a.composePoint(place))) return kWallOfB;
        const DenseCell* cell = cellAt(a, place);
        if (cell == nullptr || cell->state() == CellState::unknown) return kUnknown;
        return isWall(cell->state()) ? kWallOfA : kFree;
      });
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    drawOutline(picture, b, poses[k].a_from_b.mean,
                fmt::format("{}: {:.0f} %", k + 1, 100 * poses[k].weight));
  }
  picture.drawAxes();
  picture.put(kMargin, 8, title, kText);
  picture.put(kMargin, 36, fmt::format("poses that are possible: {}", poses.size()), kText);
  return std::move(picture.image());
}
}  // namespace sigloc
