// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/FeatureMerger.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/cell_key.h"
#include "geometry/CellHash.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kSegmentCell = 1.0;  // [m] of the hash over walls
constexpr double kPlaceCell = 0.5;  // [m] of the hash over point-like features
constexpr double kPoseSigma = 0.03;  // [m] of the poses of the scans, eq. (2.7)
constexpr double kHeadingSigma = 0.01;  // [rad] of the headings of the scans
constexpr double kMaxTurn = 0.4;  // [rad] between sightings of one corner or wall end
constexpr double kEndNearCorner = 0.3;  // [m] within which a wall end is that of a corner

std::uint64_t keyAt(double x, double y, double size)
{
  return cellKey(static_cast<std::int32_t>(std::floor(x / size)),
                 static_cast<std::int32_t>(std::floor(y / size)));
}

/// Calls `visit(x, y)` at points every `spacing` along a segment prolonged by `beyond` [m] at both
/// ends, which are included.
template <class Visit>
void walkAlong(const Feature& segment, double spacing, double beyond, Visit&& visit)
{
  const TPoint2D tangent = tangentVector(segment);
  const TPoint2D start = segmentStart(segment) - tangent * beyond;
  const double length = segment.size + 2 * beyond;
  const int steps = static_cast<int>(std::ceil(length / spacing));
  for (int k = 0; k <= steps; ++k)
  {
    const TPoint2D p = start + tangent * std::min(length, k * spacing);
    visit(p.x, p.y);
  }
}
}  // namespace

FeatureMerger::FeatureMerger(const MapBuildingOptions& options, std::vector<MergedSegment> segments,
                             std::vector<MergedPlace> places)
    : options_(options), segments_(std::move(segments)), places_(std::move(places))
{
  for (std::uint32_t k = 0; k < segments_.size(); ++k)
  {
    segments_[k].last_scan = 0;
    registerSegment(k, segments_[k].line);
  }
  for (std::uint32_t k = 0; k < places_.size(); ++k)
  {
    places_[k].last_scan = 0;
    registerPlace(k);
  }
}

void FeatureMerger::add(const std::vector<Feature>& features_in_map)
{
  ++scan_;
  for (const Feature& feature : features_in_map)
  {
    if (isSegment(feature.type))
    {
      addSegment(feature);
    }
    else
    {
      addPlace(feature);
    }
  }
}

bool FeatureMerger::fits(const Feature& mapped, const Feature& segment, double& offset) const
{
  if (std::abs(wrapToPi(mapped.direction - segment.direction)) > options_.merge_angle) return false;
  const TPoint2D normal = directionVector(mapped);
  const TPoint2D tangent = tangentVector(mapped);
  const TPoint2D a = segmentStart(segment) - mapped.position;
  const TPoint2D b = segmentEnd(segment) - mapped.position;
  const double offset_a = std::abs(normal.x * a.x + normal.y * a.y);
  const double offset_b = std::abs(normal.x * b.x + normal.y * b.y);
  offset = std::max(offset_a, offset_b);
  if (offset > options_.merge_offset) return false;
  const double along_a = tangent.x * a.x + tangent.y * a.y;
  const double along_b = tangent.x * b.x + tangent.y * b.y;
  const double reach = 0.5 * mapped.size + options_.merge_gap;
  return std::min(along_a, along_b) < reach && std::max(along_a, along_b) > -reach;
}

void FeatureMerger::addSegment(const Feature& segment)
{
  std::int64_t best = -1;
  double best_offset = 1e9;
  const auto look = [&](double x, double y)
  {
    const auto cell = segment_cells_.find(keyAt(x, y, kSegmentCell));
    if (cell == segment_cells_.end()) return;
    for (const std::uint32_t k : cell->second)
    {
      double offset = 0;
      if (!fits(segments_[k].line, segment, offset)) continue;
      if (offset < best_offset || (offset == best_offset && k < best))
      {
        best = k;
        best_offset = offset;
      }
    }
  };
  // Segments that may merge are within these margins, perhaps across the border of a cell.
  const TPoint2D aside = directionVector(segment) * options_.merge_offset;
  walkAlong(segment, 0.5 * kSegmentCell, options_.merge_gap,
            [&](double x, double y)
            {
              look(x, y);
              look(x - aside.x, y - aside.y);
              look(x + aside.x, y + aside.y);
            });
  if (best < 0)
  {
    best = static_cast<std::int64_t>(segments_.size());
    segments_.emplace_back();
    segments_.back().line = segment;
  }
  const auto index = static_cast<std::uint32_t>(best);
  absorb(segments_[index], segment);
  registerSegment(index, segments_[index].line);
}

void FeatureMerger::absorb(MergedSegment& merged, const Feature& segment)
{
  // A piece of wall counts like evenly spread points, eq. (2.6): by its length, middle and spread.
  const TPoint2D tangent = tangentVector(segment);
  const double w = segment.size;
  const double spread = w * w * w / 12.0;
  const TPoint2D p = segment.position;
  merged.weight += w;
  merged.weighted_sum += p * w;
  merged.xx += w * p.x * p.x + spread * tangent.x * tangent.x;
  merged.xy += w * p.x * p.y + spread * tangent.x * tangent.y;
  merged.yy += w * p.y * p.y + spread * tangent.y * tangent.y;
  if (merged.last_scan != scan_) ++merged.sightings;
  merged.last_scan = scan_;

  const TPoint2D old_start = segmentStart(merged.line);
  const TPoint2D old_end = segmentEnd(merged.line);
  const TPoint2D mean = merged.weighted_sum * (1.0 / merged.weight);
  const double sxx = merged.xx - merged.weight * mean.x * mean.x;
  const double sxy = merged.xy - merged.weight * mean.x * mean.y;
  const double syy = merged.yy - merged.weight * mean.y * mean.y;
  double normal = 0.5 * std::atan2(2 * sxy, sxx - syy) + 0.5 * M_PI;
  if (std::cos(normal - segment.direction) < 0) normal += M_PI;
  Feature& line = merged.line;
  line.direction = wrapToPi(normal);
  const TPoint2D along = tangentVector(line);
  const auto place = [&](const TPoint2D& q)
  { return (q.x - mean.x) * along.x + (q.y - mean.y) * along.y; };
  double low = std::min(place(segmentStart(segment)), place(segmentEnd(segment)));
  double high = std::max(place(segmentStart(segment)), place(segmentEnd(segment)));
  low = std::min({low, place(old_start), place(old_end)});
  high = std::max({high, place(old_start), place(old_end)});
  line.size = high - low;
  line.position = mean + along * (0.5 * (low + high));
}

void FeatureMerger::registerSegment(std::uint32_t index, const Feature& segment)
{
  walkAlong(segment, 0.5 * kSegmentCell, 0.0,
            [&](double x, double y)
            {
              auto& cell = segment_cells_[keyAt(x, y, kSegmentCell)];
              if (std::find(cell.begin(), cell.end(), index) == cell.end()) cell.push_back(index);
            });
}

void FeatureMerger::registerPlace(std::uint32_t index)
{
  const TPoint2D& p = places_[index].feature.position;
  place_cells_[keyAt(p.x, p.y, kPlaceCell)].push_back(index);
}

void FeatureMerger::addPlace(const Feature& place)
{
  const double reach = options_.merge_point_distance;
  const int cells = static_cast<int>(std::ceil(reach / kPlaceCell));
  std::int64_t best = -1;
  double best_distance = reach;
  for (int dx = -cells; dx <= cells; ++dx)
  {
    for (int dy = -cells; dy <= cells; ++dy)
    {
      const auto cell = place_cells_.find(keyAt(place.position.x + dx * kPlaceCell,
                                                place.position.y + dy * kPlaceCell, kPlaceCell));
      if (cell == place_cells_.end()) continue;
      for (const std::uint32_t k : cell->second)
      {
        const Feature& mapped = places_[k].feature;
        if (mapped.type != place.type || mapped.side != place.side || mapped.label != place.label)
          continue;
        if (hasBearing(place.type) &&
            std::abs(wrapToPi(mapped.direction - place.direction)) > kMaxTurn)
          continue;
        const double distance = (mapped.position - place.position).norm();
        if (distance < best_distance)
        {
          best = k;
          best_distance = distance;
        }
      }
    }
  }
  if (best < 0)
  {
    MergedPlace fresh;
    fresh.feature = place;
    fresh.feature.parent = -1;
    fresh.feature.sightings = 1;
    fresh.cosine_sum = std::cos(place.direction);
    fresh.sine_sum = std::sin(place.direction);
    fresh.last_scan = scan_;
    places_.push_back(fresh);
    registerPlace(static_cast<std::uint32_t>(places_.size() - 1));
    return;
  }
  MergedPlace& merged = places_[static_cast<std::size_t>(best)];
  Feature& feature = merged.feature;
  // Running means. The hash keeps the first place, from which the mean moves by less than a cell.
  const double n = merged.count++;
  feature.position = (feature.position * n + place.position) * (1.0 / (n + 1));
  feature.size = isSeenInPart(place.type) ? std::max(feature.size, place.size)
                                          : (feature.size * n + place.size) / (n + 1);
  merged.cosine_sum += std::cos(place.direction);
  merged.sine_sum += std::sin(place.direction);
  feature.direction = std::atan2(merged.sine_sum, merged.cosine_sum);
  for (int r = 0; r < 2; ++r)
  {
    for (int c = 0; c < 2; ++c)
    {
      feature.position_covariance(r, c) =
          (feature.position_covariance(r, c) * n + place.position_covariance(r, c)) / (n + 1);
    }
  }
  if (merged.last_scan != scan_) ++feature.sightings;
  merged.last_scan = scan_;
}

namespace
{
/// Sets the covariance of a merged place. Averaging reduces the errors that are independent between
/// scans, including those of the poses, down to a floor. Eq. (2.7)
void setPlaceCovariance(Feature& feature)
{
  const double n = std::min(feature.sightings, 9U);
  for (int k = 0; k < 2; ++k)
  {
    for (int l = 0; l < 2; ++l) feature.position_covariance(k, l) /= n;
    feature.position_covariance(k, k) += kPoseSigma * kPoseSigma / n + 1e-4;
  }
  feature.direction_variance = feature.direction_variance / n + kHeadingSigma * kHeadingSigma;
}

void setSegmentCovariance(Feature& segment, std::uint32_t sightings)
{
  const double n = std::min(sightings, 9U);
  const double across = kPoseSigma * kPoseSigma / n + 1e-4;
  const double along = 0.05 * 0.05;
  const double c = std::cos(segment.direction);
  const double s = std::sin(segment.direction);
  segment.position_covariance(0, 0) = across * c * c + along * s * s;
  segment.position_covariance(1, 1) = across * s * s + along * c * c;
  segment.position_covariance(0, 1) = segment.position_covariance(1, 0) = (across - along) * s * c;
  const double lever = std::max(segment.size, 0.3);
  segment.direction_variance =
      kHeadingSigma * kHeadingSigma / n + 12.0 * 1e-4 / (lever * lever * n);
  segment.size_variance = 2 * along;
  segment.sightings = sightings;
}

/// Returns the end of one of the two walls that meet in a convex corner. Most scans see one of the
/// faces only, which ends in a jump.
Feature wallEndOfCorner(const Feature& corner, WallSide side)
{
  const double turn = M_PI - corner.size;
  const bool first = side == WallSide::end;  // the first wall ends here, the second one starts
  const double normal = corner.direction + (first ? -0.5 : 0.5) * turn;
  Feature end = corner;
  end.type = FeatureType::wall_end;
  end.side = side;
  end.direction = wrapToPi(first ? normal + 0.5 * M_PI : normal - 0.5 * M_PI);
  end.size = 0;
  return end;
}
}  // namespace

std::vector<Feature> FeatureMerger::features() const
{
  std::vector<Feature> out;
  for (const MergedSegment& merged : segments_)
  {
    if (merged.sightings < options_.min_sightings) continue;
    Feature segment = merged.line;
    setSegmentCovariance(segment, merged.sightings);
    segment.start_seen = segment.end_seen = false;
    out.push_back(segment);
  }

  CellHash seen_ends(kEndNearCorner);
  std::vector<Feature> completed;  // wall ends of convex corners, where none was seen
  for (const MergedPlace& merged : places_)
  {
    if (merged.feature.sightings < options_.min_sightings) continue;
    Feature place = merged.feature;
    setPlaceCovariance(place);
    if (place.type == FeatureType::wall_end)
    {
      seen_ends.add(place.position, static_cast<std::uint32_t>(out.size()));
    }
    out.push_back(place);
    if (place.type != FeatureType::corner || place.size < M_PI) continue;
    for (const WallSide side : {WallSide::start, WallSide::end})
    {
      completed.push_back(wallEndOfCorner(place, side));
    }
  }
  for (const Feature& end : completed)
  {
    bool seen = false;
    seen_ends.forEachNear(end.position,
                          [&](std::uint32_t k)
                          {
                            const Feature& other = out[k];
                            seen = seen ||
                                   (other.side == end.side &&
                                    (other.position - end.position).norm() < kEndNearCorner &&
                                    std::abs(wrapToPi(other.direction - end.direction)) < kMaxTurn);
                          });
    if (!seen) out.push_back(end);
  }
  return out;
}
}  // namespace sigloc
