// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/ScanPoints.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
bool coversFullCircle(const LaserScan& scan)
{
  const double span = scan.angle_step * static_cast<double>(scan.ranges.size());
  return span > 2 * M_PI - 1.5 * scan.angle_step;
}

bool breaksBetween(const ScanPoints& scan, std::size_t i, std::size_t j,
                   const FeatureExtractorOptions& options)
{
  const double nearer = std::min(scan.ranges[i], scan.ranges[j]);
  const double limit =
      std::max(options.break_distance, options.break_factor * nearer * scan.beam_spacing);
  return (scan.points[j] - scan.points[i]).norm() > limit;
}

/// Returns the number of beams from return `from` to the next return `to`, across the seam of a
/// full circle.
std::size_t beamsBetween(const ScanPoints& scan, std::size_t from, std::size_t to)
{
  if (scan.beams[to] >= scan.beams[from]) return scan.beams[to] - scan.beams[from];
  const auto turn = static_cast<std::size_t>(std::lround(2 * M_PI / scan.beam_spacing));
  const std::size_t last = scan.beams[to] + turn;
  return last > scan.beams[from] ? last - scan.beams[from] : 0;
}

struct Neighbour
{
  std::size_t index;
  std::size_t beams;  // from one return to the other
};

/// Returns the return beyond `edge` (towards `step`); none at the end of the field of view.
std::optional<Neighbour> neighbourOf(const ScanPoints& scan, std::size_t edge, int step)
{
  const std::size_t n = scan.points.size();
  const bool at_seam = step > 0 ? edge + 1 == n : edge == 0;
  if (at_seam && !scan.closed) return std::nullopt;
  const std::size_t other = step > 0 ? (edge + 1) % n : (edge + n - 1) % n;
  return Neighbour{other,
                   step > 0 ? beamsBetween(scan, edge, other) : beamsBetween(scan, other, edge)};
}
/// Returns the return farthest off the chord of a range, or nullopt where none is off by more than
/// the split distance.
std::optional<std::size_t> splitOf(const ScanPoints& scan, const PointRange& range,
                                   const FeatureExtractorOptions& options)
{
  const TPoint2D a = scan.points[range.first];
  const TPoint2D chord = scan.points[range.last] - a;
  const double length = chord.norm();
  // A closed outline has no usable chord.
  const bool is_closed = length < options.split_distance;
  double farthest = 0;
  std::size_t at = range.first;
  for (std::size_t i = range.first + 1; i < range.last; ++i)
  {
    const TPoint2D d = scan.points[i] - a;
    const double off = is_closed ? d.norm() : std::abs(chord.x * d.y - chord.y * d.x) / length;
    if (off > farthest)
    {
      farthest = off;
      at = i;
    }
  }
  return farthest > options.split_distance ? std::optional(at) : std::nullopt;
}

}  // namespace

ScanPoints validPoints(const LaserScan& scan, const FeatureExtractorOptions& options)
{
  const std::size_t n = scan.ranges.size();
  ScanPoints out;
  out.beam_count = n;
  out.beam_spacing = scan.angle_step;
  out.max_range = std::min(scan.max_range, kFarthestReturn);
  out.closed = coversFullCircle(scan);
  out.points.reserve(n);
  out.ranges.reserve(n);
  out.beams.reserve(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const double range = static_cast<double>(scan.ranges[i]);
    if (scan.valid[i] == 0 || !std::isfinite(range) || range < options.min_range || range <= 0 ||
        range > out.max_range)
    {
      continue;
    }
    const double angle = angleOf(scan, i);
    out.points.emplace_back(range * std::cos(angle), range * std::sin(angle));
    out.ranges.push_back(range);
    out.beams.push_back(i);
  }
  return out;
}

bool dropSpeckles(ScanPoints& scan, const FeatureExtractorOptions& options)
{
  constexpr std::size_t kReach = 2;  // returns on either side that are compared
  constexpr std::size_t kFarther = 3;  // of those four, that must be farther
  const std::size_t n = scan.points.size();
  const auto is_speckle = [&](std::size_t i)
  {
    std::size_t farther = 0;
    for (std::size_t step = 1; step <= kReach; ++step)
    {
      const std::size_t before = i >= step ? i - step : i + n - step;
      const std::size_t after = i + step < n ? i + step : i + step - n;
      for (const std::size_t other : {before, after})
      {
        const bool across_seam = other > i ? other - i > kReach : i - other > kReach;
        if (across_seam && !scan.closed) continue;
        if (!breaksBetween(scan, i, other, options)) return false;
        farther += scan.ranges[other] > scan.ranges[i];
      }
    }
    return farther >= kFarther;
  };
  if (n <= 2 * kReach) return false;
  std::vector<std::uint8_t> speckles(n);
  for (std::size_t i = 0; i < n; ++i) speckles[i] = is_speckle(i) ? 1 : 0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i)
  {
    if (speckles[i] != 0) continue;
    scan.points[kept] = scan.points[i];
    scan.ranges[kept] = scan.ranges[i];
    scan.beams[kept] = scan.beams[i];
    ++kept;
  }
  scan.points.resize(kept);
  scan.ranges.resize(kept);
  scan.beams.resize(kept);
  return kept < n;
}

void startAtBreak(ScanPoints& scan, const FeatureExtractorOptions& options)
{
  const std::size_t n = scan.points.size();
  if (!scan.closed || n < 3 || breaksBetween(scan, n - 1, 0, options)) return;
  std::size_t start = 1;
  while (start < n && !breaksBetween(scan, start - 1, start, options)) ++start;
  if (start == n)
  {
    const auto farthest = std::max_element(scan.ranges.begin(), scan.ranges.end());
    start = static_cast<std::size_t>(farthest - scan.ranges.begin());
  }
  const auto shift = static_cast<std::ptrdiff_t>(start);
  std::rotate(scan.points.begin(), scan.points.begin() + shift, scan.points.end());
  std::rotate(scan.ranges.begin(), scan.ranges.begin() + shift, scan.ranges.end());
  std::rotate(scan.beams.begin(), scan.beams.begin() + shift, scan.beams.end());
}

std::vector<PointRange> clustersOf(const ScanPoints& scan, const FeatureExtractorOptions& options)
{
  std::vector<PointRange> clusters;
  std::size_t first = 0;
  for (std::size_t i = 1; i <= scan.points.size(); ++i)
  {
    if (i == scan.points.size() || breaksBetween(scan, i - 1, i, options))
    {
      if (!scan.points.empty()) clusters.push_back({first, i - 1});
      first = i;
    }
  }
  return clusters;
}

bool jumpsFarther(const ScanPoints& scan, std::size_t edge, int step,
                  const FeatureExtractorOptions& options)
{
  const auto next = neighbourOf(scan, edge, step);
  return next && next->beams <= 2 &&
         scan.ranges[next->index] > scan.ranges[edge] + options.wall_end_jump;
}

bool standsFree(const ScanPoints& scan, std::size_t edge, int step,
                const FeatureExtractorOptions& options)
{
  if (jumpsFarther(scan, edge, step, options)) return true;
  constexpr std::size_t kSky = 6;  // beams lost in a row that count as sky
  constexpr double kWellWithin = 0.9;  // share of the range beyond which lost beams prove nothing
  if (scan.ranges[edge] > kWellWithin * scan.max_range) return false;
  const auto next = neighbourOf(scan, edge, step);
  const std::size_t to_the_end =
      step > 0 ? scan.beam_count - scan.beams[edge] : scan.beams[edge] + 1;
  return (next ? next->beams : to_the_end) > kSky;
}

void splitRange(const ScanPoints& scan, PointRange range, const FeatureExtractorOptions& options,
                std::vector<PointRange>& pieces)
{
  std::vector<PointRange> left = {range};
  while (!left.empty())
  {
    const PointRange piece = left.back();
    left.pop_back();
    if (piece.last < piece.first + 1) continue;
    if (const auto at = splitOf(scan, piece, options))
    {
      left.push_back({*at, piece.last});
      left.push_back({piece.first, *at});
    }
    else
    {
      pieces.push_back(piece);
    }
  }
}
}  // namespace sigloc
