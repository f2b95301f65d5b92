// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "wall_points.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <optional>

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kOnWall = 0.15;  // [m] from a ridge
constexpr double kPointsPerMeasurement = 20;  // neighbours on a wall share their errors
constexpr double kLeastSigma = 0.02;  // [m] of a wall, whatever the residuals

/// From a point to the ridge of the nearest wall [m]; none where that is far, or outside.
std::optional<TPoint2D> toRidge(const DenseField& field, const TPoint2D& point)
{
  const DenseCell* cell = cellAt(field, point);
  if (cell == nullptr || cell->distance() == DenseCell::kFar) return std::nullopt;
  const RasterFrame& frame = field.frame;
  const auto middle = [&](double value, double origin)
  { return origin + (std::floor((value - origin) / frame.resolution) + 0.5) * frame.resolution; };
  return TPoint2D(middle(point.x, frame.origin.x) + cell->dx * DenseField::kOffsetUnit - point.x,
                  middle(point.y, frame.origin.y) + cell->dy * DenseField::kOffsetUnit - point.y);
}

/// The normal equations of one step of least squares, about the middle of the points.
struct Normal
{
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double squares = 0;
  double count = 0;

  /// A residual along `normal` at `arm`, from the point that the pose turns about.
  void add(const TPoint2D& off, const TPoint2D& arm)
  {
    const double length = std::hypot(off.x, off.y);
    if (length < 1e-6) return;
    const TPoint2D normal = off / length;
    const Eigen::Vector3d row(normal.x, normal.y, -normal.x * arm.y + normal.y * arm.x);
    information += row * row.transpose();
    gradient += row * length;
    squares += length * length;
    count += 1;
  }
};

Normal normalAt(const DenseField& a, const std::vector<TPoint2D>& points, const TPose2D& pose,
                double reach)
{
  Normal normal;
  for (const TPoint2D& point : points)
  {
    const TPoint2D there = pose.composePoint(point);
    const auto off = toRidge(a, there);
    if (!off || std::hypot(off->x, off->y) > reach) continue;
    normal.add(*off, there - TPoint2D(pose.x, pose.y));
  }
  return normal;
}

/// Keeps the equations solvable where all walls run one way.
Eigen::Matrix3d regular(const Eigen::Matrix3d& information)
{
  return information + Eigen::Matrix3d::Identity() * 1e-3;
}

void judge(const DenseField& a, const std::vector<TPoint2D>& points, MapPose& pose)
{
  double mapped = 0;
  double on_wall = 0;
  for (const TPoint2D& point : points)
  {
    const TPoint2D there = pose.a_from_b.mean.composePoint(point);
    const DenseCell* cell = cellAt(a, there);
    const auto off = toRidge(a, there);
    const bool near = off && std::hypot(off->x, off->y) < kOnWall;
    on_wall += near ? 1 : 0;
    mapped += near || (cell != nullptr && cell->state() != CellState::unknown) ? 1 : 0;
  }
  pose.overlap = mapped / static_cast<double>(std::max<std::size_t>(1, points.size()));
  pose.explained = mapped > 0 ? on_wall / mapped : 0;
}
}  // namespace

std::vector<TPoint2D> wallPoints(const DenseField& field, std::size_t most)
{
  std::vector<TPoint2D> solid;
  std::vector<TPoint2D> all;
  const RasterFrame& frame = field.frame;
  const auto add = [&](const DenseCell& cell, std::uint32_t column, std::uint32_t row)
  {
    if (!isWall(cell.state())) return;
    const double x = (column + 0.5) * frame.resolution;
    const double y = (row + 0.5) * frame.resolution;
    const TPoint2D ridge(frame.origin.x + x + cell.dx * DenseField::kOffsetUnit,
                         frame.origin.y + y + cell.dy * DenseField::kOffsetUnit);
    all.push_back(ridge);
    if (cell.state() == CellState::solid_wall) solid.push_back(ridge);
  };
  for (const StoredCells& stored : storedCells(field))
  {
    for (std::uint32_t y = 0; y < stored.height; ++y)
    {
      for (std::uint32_t x = 0; x < stored.width; ++x)
        add(stored.row(y)[x], stored.x + x, stored.y + y);
    }
  }
  const std::vector<TPoint2D>& points = 5 * solid.size() > all.size() ? solid : all;
  std::vector<TPoint2D> chosen;
  const std::size_t count = std::min(most, points.size());
  chosen.reserve(count);
  for (std::size_t k = 0; k < count; ++k) chosen.push_back(points[k * points.size() / count]);
  return chosen;
}

void refinePose(const DenseField& a, const std::vector<TPoint2D>& points_of_b, MapPose& pose)
{
  TPose2D& mean = pose.a_from_b.mean;
  double reach = 0;
  for (const double step_reach : {1.0, 0.7, 0.5, 0.4, 0.3, 0.3, 0.2, 0.2, 0.2, 0.2})
  {
    reach = step_reach;
    const Normal normal = normalAt(a, points_of_b, mean, reach);
    if (normal.count < 3) break;
    const Eigen::Vector3d step = regular(normal.information).ldlt().solve(normal.gradient);
    mean.x += step(0);
    mean.y += step(1);
    mean.phi += step(2);
    mean.normalizePhi();
  }
  const Normal normal = normalAt(a, points_of_b, mean, reach);
  const double sigma =
      std::max(kLeastSigma, std::sqrt(normal.squares / std::max(1.0, normal.count)));
  const Eigen::Matrix3d covariance =
      regular(normal.information).inverse() * (sigma * sigma * kPointsPerMeasurement);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
      pose.a_from_b.covariance(row, column) = covariance(row, column);
  }
  judge(a, points_of_b, pose);
}
}  // namespace sigloc
