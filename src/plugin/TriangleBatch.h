// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TColor.h>
#include <mrpt/math/TPoint2D.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CSetOfTriangles.h>

#include <vector>

namespace sigloc::detail
{
/// Flat coloured shapes over the map plane, collected into objects of one layer. Thick lines are
/// made of them where the renderer draws only thin ones.
///
/// MRPT 2.5.8 leaves out an object when all corners of its box are behind the viewer or beyond what
/// he sees, though its middle may be in front of him. Each object therefore holds only the shapes
/// of one tile.
class TriangleBatch
{
 public:
  using Point = mrpt::math::TPoint2D;

  /// `height` is the z of all shapes [m]: higher batches cover lower ones.
  explicit TriangleBatch(double height) : height_(height) {}

  void addTriangle(const Point& a, const Point& b, const Point& c, const mrpt::img::TColor& color);
  /// A strip of the given width [m] from a to b, with square caps half a width long.
  void addLine(const Point& a, const Point& b, double width, const mrpt::img::TColor& color);
  void addPolyline(const std::vector<Point>& points, double width, bool closed,
                   const mrpt::img::TColor& color);
  void addRing(const Point& centre, double radius, double width, const mrpt::img::TColor& color);
  void addDisc(const Point& centre, double radius, const mrpt::img::TColor& color);
  void addSquare(const Point& centre, double side, const mrpt::img::TColor& color);

  /// One CSetOfTriangles for each tile of 10 m that has a shape in it.
  mrpt::opengl::CSetOfObjects::Ptr object() const;

 private:
  double height_;
  std::vector<mrpt::opengl::TTriangle> triangles_;
};
}  // namespace sigloc::detail
