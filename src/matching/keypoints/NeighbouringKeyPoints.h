// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "matching/keypoints/KeyPoint.h"

namespace sigloc
{
/// Distances [m] from `least` on, up to and without `end`.
struct Distances
{
  double least = 0, end = 0;
};

/// The key points of one kind by place, to find the partners of others among them.
class KeyPointsOfAKind
{
 public:
  KeyPointsOfAKind(const std::vector<KeyPoint>& points, KeyPointKind kind) : points_(points)
  {
    for (std::uint32_t k = 0; k < points.size(); ++k)
    {
      const mrpt::math::TPoint2D& at = points[k].position;
      if (points[k].kind == kind) places_.push_back({at.x, at.y, cellOf(at.x), cellOf(at.y), k});
    }
    std::sort(places_.begin(), places_.end(),
              [](const Place& a, const Place& b)
              {
                return a.column != b.column ? a.column < b.column
                       : a.row != b.row     ? a.row < b.row
                                            : a.index < b.index;
              });
    for (std::uint32_t k = 0; k < places_.size(); ++k)
    {
      if (k == 0 || places_[k].column != places_[k - 1].column)
        columns_.push_back({places_[k].column, k});
    }
    columns_.push_back({INT64_MAX, static_cast<std::uint32_t>(places_.size())});
  }

  /// Calls `visit(b)` for the other points of this kind that are within a range of point `i`, by
  /// column, row and index.
  template <class Visit>
  void forEachPartner(std::size_t i, const Distances& range, const Visit& visit) const
  {
    const mrpt::math::TPoint2D& from = points_[i].position;
    const double reach = range.end + 1e-6;  // rounding takes no point away
    const std::int64_t lowest = cellOf(from.y - reach);
    const std::int64_t highest = cellOf(from.y + reach);
    const std::int64_t last = cellOf(from.x + reach);
    auto column = std::lower_bound(columns_.begin(), columns_.end(), cellOf(from.x - reach),
                                   [](const Column& c, std::int64_t x) { return c.column < x; });
    for (; column->column <= last; ++column)
    {
      const Place* const end = places_.data() + (column + 1)->first;
      const Place* to =
          std::lower_bound(places_.data() + column->first, end, lowest,
                           [](const Place& place, std::int64_t row) { return place.row < row; });
      for (; to != end && to->row <= highest; ++to)
      {
        const double dx = to->x - from.x;
        const double dy = to->y - from.y;
        const double squared = dx * dx + dy * dy;
        if (squared < range.least * range.least || squared >= range.end * range.end) continue;
        if (i != to->index) visit(points_[to->index]);
      }
    }
  }

 private:
  struct Place
  {
    double x, y;  // [m]
    std::int64_t column, row;  // of kCell
    std::uint32_t index;
  };
  struct Column
  {
    std::int64_t column;
    std::uint32_t first;  // of its places
  };

  static std::int64_t cellOf(double metres)
  {
    return static_cast<std::int64_t>(std::floor(metres / kCell));
  }

  static constexpr double kCell = 4.0;  // [m]

  const std::vector<KeyPoint>& points_;
  std::vector<Place> places_;  // by column, then by row
  std::vector<Column> columns_;  // those with places, and an end
};

/// The key points of a map by place, each kind apart, to find pairs of them. Keeps a reference to
/// the points, which must outlive it.
class NeighbouringKeyPoints
{
 public:
  explicit NeighbouringKeyPoints(const std::vector<KeyPoint>& points) : points_(points)
  {
    for (std::size_t kind = 0; kind < kKeyPointKinds; ++kind)
      of_kind_.emplace_back(points, static_cast<KeyPointKind>(kind));
  }

  /// Calls `visit(a, b)` for the ordered pairs of two kinds within a range: by a, then by column,
  /// row and index of b.
  template <class Visit>
  void forEachPair(std::size_t first, std::size_t second, const Distances& range,
                   const Visit& visit) const
  {
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
      if (static_cast<std::size_t>(points_[i].kind) != first) continue;
      of_kind_[second].forEachPartner(i, range, [&](const KeyPoint& b) { visit(points_[i], b); });
    }
  }

  /// Calls `visit(a, b)` for those whose second kind is not before the first one, where a is every
  /// `stride`-th point.
  template <class Visit>
  void forEachPair(const Distances& range, std::size_t stride, const Visit& visit) const
  {
    for (std::size_t i = 0; i < points_.size(); i += stride)
    {
      for (auto kind = static_cast<std::size_t>(points_[i].kind); kind < kKeyPointKinds; ++kind)
        of_kind_[kind].forEachPartner(i, range, [&](const KeyPoint& b) { visit(points_[i], b); });
    }
  }

 private:
  const std::vector<KeyPoint>& points_;
  std::vector<KeyPointsOfAKind> of_kind_;
};
}  // namespace sigloc
