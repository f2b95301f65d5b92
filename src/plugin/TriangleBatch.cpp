// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/TriangleBatch.h"

#include <cmath>

namespace sigloc::detail
{
namespace
{
constexpr int kRoundSides = 32;

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

mrpt::opengl::CSetOfTriangles::Ptr TriangleBatch::object() const
{
  auto object = mrpt::opengl::CSetOfTriangles::Create();
  object->insertTriangles(triangles_.begin(), triangles_.end());
  // Flat colours: lighting would make equal colours look different from above.
  object->enableLight(false);
  return object;
}
}  // namespace sigloc::detail
