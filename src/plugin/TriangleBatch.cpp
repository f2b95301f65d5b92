// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/TriangleBatch.h"

#include <cmath>
#include <map>
#include <utility>

namespace sigloc::detail
{
namespace
{
constexpr int kRoundSides = 32;
constexpr double kTile = 10;  // [m]

std::vector<TriangleBatch::Point> circlePoints(const TriangleBatch::Point& centre, double radius)
{
  std::vector<TriangleBatch::Point> points;
  for (int i = 0; i < kRoundSides; ++i)
  {
    const double angle = 2 * M_PI * i / kRoundSides;
    points.push_back(centre + TriangleBatch::Point(std::cos(angle), std::sin(angle)) * radius);
  }
  return points;
}
}  // namespace

void TriangleBatch::addTriangle(const Point& a, const Point& b, const Point& c,
                                const mrpt::img::TColor& color)
{
  const auto lifted = [&](const Point& p)
  {
    return mrpt::math::TPoint3Df(static_cast<float>(p.x), static_cast<float>(p.y),
                                 static_cast<float>(height_));
  };
  mrpt::opengl::TTriangle triangle(lifted(a), lifted(b), lifted(c));
  triangle.setColor(color);
  triangles_.push_back(triangle);
}

void TriangleBatch::addLine(const Point& a, const Point& b, double width,
                            const mrpt::img::TColor& color)
{
  const Point along = b - a;
  const double length = std::hypot(along.x, along.y);
  if (length > kTile)  // no shape is larger than a tile
  {
    const Point middle = a + along * 0.5;
    addLine(a, middle, width, color);
    addLine(middle, b, width, color);
    return;
  }
  const Point unit = length > 0 ? along * (1 / length) : Point(1, 0);
  const Point cap = unit * (0.5 * width);
  const Point side = Point(-unit.y, unit.x) * (0.5 * width);
  const Point a1 = a - cap - side;
  const Point a2 = a - cap + side;
  const Point b1 = b + cap - side;
  const Point b2 = b + cap + side;
  addTriangle(a1, b1, b2, color);
  addTriangle(a1, b2, a2, color);
}

void TriangleBatch::addPolyline(const std::vector<Point>& points, double width, bool closed,
                                const mrpt::img::TColor& color)
{
  for (std::size_t i = 1; i < points.size(); ++i) addLine(points[i - 1], points[i], width, color);
  if (closed && points.size() > 2) addLine(points.back(), points.front(), width, color);
}

void TriangleBatch::addRing(const Point& centre, double radius, double width,
                            const mrpt::img::TColor& color)
{
  addPolyline(circlePoints(centre, radius), width, true, color);
}

void TriangleBatch::addDisc(const Point& centre, double radius, const mrpt::img::TColor& color)
{
  const std::vector<Point> rim = circlePoints(centre, radius);
  for (std::size_t i = 0; i < rim.size(); ++i)
  {
    addTriangle(centre, rim[i], rim[(i + 1) % rim.size()], color);
  }
}

void TriangleBatch::addSquare(const Point& centre, double side, const mrpt::img::TColor& color)
{
  addLine(centre, centre, side, color);  // nothing but the two caps
}

mrpt::opengl::CSetOfObjects::Ptr TriangleBatch::object() const
{
  using Tile = std::pair<long, long>;
  std::map<Tile, std::vector<mrpt::opengl::TTriangle>> tiles;
  for (const mrpt::opengl::TTriangle& triangle : triangles_)
  {
    const auto tile_of = [](float x) { return std::lround(std::floor(x / kTile)); };
    tiles[{tile_of(triangle.x(0)), tile_of(triangle.y(0))}].push_back(triangle);
  }
  auto objects = mrpt::opengl::CSetOfObjects::Create();
  for (const auto& [tile, triangles] : tiles)
  {
    auto object = mrpt::opengl::CSetOfTriangles::Create();
    object->insertTriangles(triangles.begin(), triangles.end());
    // Flat colours: lighting would make equal colours look different from above.
    object->enableLight(false);
    objects->insert(object);
  }
  return objects;
}
}  // namespace sigloc::detail
