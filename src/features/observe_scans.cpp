// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/features/observe_scans.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "features/line_fit.h"
#include "features/ScanPoints.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr double kSurfaceSigma = 0.008;  // [m] roughness of walls and mixed pixels, eq. (2.3)
constexpr double kRadiusPriorSigma = 0.12;  // [m] of the prior of a radius, eq. (2.2)
constexpr double kMinCornerAngle = 0.35;  // [rad] below which a joint is no corner

Feature makeSegment(const ScanPoints& scan, PointRange range, double range_sigma)
{
  const LineFit fit =
      fitLine(scan.points, range.first, range.last, {0, 0}, range_sigma, kSurfaceSigma);
  Feature segment;
  segment.type = FeatureType::segment;
  segment.direction = fit.normal;
  const TPoint2D tangent(std::sin(fit.normal), -std::cos(fit.normal));
  const auto along = [&](const TPoint2D& p)
  { return (p.x - fit.centroid.x) * tangent.x + (p.y - fit.centroid.y) * tangent.y; };
  const double start = along(scan.points[range.first]);
  const double end = along(scan.points[range.last]);
  const double middle = 0.5 * (start + end);
  segment.position = fit.centroid + tangent * middle;
  segment.size = std::abs(end - start);
  segment.direction_variance = fit.angle_variance;
  const double normal_variance = fit.offset_variance + middle * middle * fit.angle_variance;
  const double spacing = segment.size / static_cast<double>(range.last - range.first);
  const double end_variance = range_sigma * range_sigma + spacing * spacing / 12.0;
  const double c = std::cos(fit.normal);
  const double s = std::sin(fit.normal);
  segment.position_covariance(0, 0) = normal_variance * c * c + 0.5 * end_variance * s * s;
  segment.position_covariance(1, 1) = normal_variance * s * s + 0.5 * end_variance * c * c;
  segment.position_covariance(0, 1) = segment.position_covariance(1, 0) =
      (normal_variance - 0.5 * end_variance) * s * c;
  segment.size_variance = 2.0 * end_variance;
  return segment;
}

/// Joins neighbouring pieces on one line, because the split between them was noise.
std::vector<PointRange> rejoined(const ScanPoints& scan, const std::vector<PointRange>& pieces,
                                 const FeatureExtractorOptions& options)
{
  std::vector<PointRange> joined;
  for (const PointRange& piece : pieces)
  {
    if (!joined.empty() && joined.back().last == piece.first)
    {
      const PointRange both{joined.back().first, piece.last};
      const LineFit fit = fitLine(scan.points, both.first, both.last, {0, 0}, 0.01, kSurfaceSigma);
      const double c = std::cos(fit.normal);
      const double s = std::sin(fit.normal);
      double worst = 0;
      for (std::size_t i = both.first; i <= both.last; ++i)
      {
        const TPoint2D d = scan.points[i] - fit.centroid;
        worst = std::max(worst, std::abs(d.x * c + d.y * s));
      }
      if (worst <= 0.75 * options.split_distance)
      {
        joined.back() = both;
        continue;
      }
    }
    joined.push_back(piece);
  }
  return joined;
}

/// What may be behind a post, on either side.
enum class Background
{
  farther,
  farther_or_sky
};

bool standsAlone(const ScanPoints& scan, PointRange range, Background background,
                 const FeatureExtractorOptions& options)
{
  const auto free = background == Background::farther ? jumpsFarther : standsFree;
  return free(scan, range.first, -1, options) && free(scan, range.last, +1, options);
}

std::optional<Feature> makeCircle(const ScanPoints& scan, PointRange range, double range_sigma,
                                  Background background, const FeatureExtractorOptions& options)
{
  if (range.last < range.first + 2) return std::nullopt;
  const double width = (scan.points[range.last] - scan.points[range.first]).norm();
  if (width >= options.max_circle_diameter || !standsAlone(scan, range, background, options))
  {
    return std::nullopt;
  }
  const CircleFit fit =
      fitCircle(scan.points, range.first, range.last, {0, 0}, range_sigma, kRadiusPriorSigma);
  if (fit.radius > 0.5 * options.max_circle_diameter || fit.rms > options.split_distance)
  {
    return std::nullopt;
  }
  Feature circle;
  circle.type = FeatureType::circle;
  circle.position = fit.centre;
  circle.size = fit.radius;
  circle.direction = std::atan2(-fit.centre.y, -fit.centre.x);
  const double c = std::cos(circle.direction);
  const double s = std::sin(circle.direction);
  const double along = fit.radial_variance;
  const double across = fit.lateral_variance;
  circle.position_covariance(0, 0) = along * c * c + across * s * s;
  circle.position_covariance(1, 1) = along * s * s + across * c * c;
  circle.position_covariance(0, 1) = circle.position_covariance(1, 0) = (along - across) * s * c;
  circle.size_variance = fit.radius_variance;
  return circle;
}

std::optional<TPoint2D> intersectionOf(const Feature& a, const Feature& b)
{
  const double determinant = std::sin(b.direction - a.direction);
  if (std::abs(determinant) < 1e-6) return std::nullopt;
  const double da = lineDistance(a);
  const double db = lineDistance(b);
  return TPoint2D((da * std::sin(b.direction) - db * std::sin(a.direction)) / determinant,
                  (db * std::cos(a.direction) - da * std::cos(b.direction)) / determinant);
}

/// Returns the corner where segment `a` ends and segment `b` begins, if their lines meet there.
/// Eq. (2.5)
std::optional<Feature> makeCorner(const Feature& a, const Feature& b,
                                  const FeatureExtractorOptions& options)
{
  const double turn = mrpt::math::wrapToPi(b.direction - a.direction);
  if (std::abs(turn) < kMinCornerAngle || std::abs(turn) > M_PI - kMinCornerAngle)
  {
    return std::nullopt;
  }
  const auto vertex = intersectionOf(a, b);
  if (!vertex || (*vertex - segmentEnd(a)).norm() > options.corner_gap ||
      (*vertex - segmentStart(b)).norm() > options.corner_gap)
  {
    return std::nullopt;
  }
  Feature corner;
  corner.type = FeatureType::corner;
  corner.position = *vertex;
  corner.direction = mrpt::math::wrapToPi(a.direction + 0.5 * turn);
  corner.size = M_PI - turn;
  corner.direction_variance = 0.25 * (a.direction_variance + b.direction_variance);
  corner.size_variance = a.direction_variance + b.direction_variance;
  // The vertex solves two line equations; each line's variance is taken at the vertex.
  const auto variance_at_vertex = [&](const Feature& segment)
  {
    const TPoint2D n = directionVector(segment);
    const auto& p = segment.position_covariance;
    const double lever = (*vertex - segment.position).norm();
    return n.x * n.x * p(0, 0) + 2 * n.x * n.y * p(0, 1) + n.y * n.y * p(1, 1) +
           lever * lever * segment.direction_variance;
  };
  const double va = variance_at_vertex(a);
  const double vb = variance_at_vertex(b);
  const double sine2 = std::sin(turn) * std::sin(turn);
  const TPoint2D ta = tangentVector(a);
  const TPoint2D tb = tangentVector(b);
  corner.position_covariance(0, 0) = (va * tb.x * tb.x + vb * ta.x * ta.x) / sine2;
  corner.position_covariance(1, 1) = (va * tb.y * tb.y + vb * ta.y * ta.y) / sine2;
  corner.position_covariance(0, 1) = corner.position_covariance(1, 0) =
      (va * tb.x * tb.y + vb * ta.x * ta.y) / sine2;
  return corner;
}

Feature makeWallEnd(const Feature& segment, WallSide side, std::int32_t parent)
{
  const TPoint2D tangent = tangentVector(segment);
  const double sign = side == WallSide::start ? 1.0 : -1.0;
  Feature end;
  end.type = FeatureType::wall_end;
  end.side = side;
  end.position = side == WallSide::start ? segmentStart(segment) : segmentEnd(segment);
  end.direction = std::atan2(sign * tangent.y, sign * tangent.x);
  end.size = segment.size;
  end.direction_variance = segment.direction_variance;
  end.size_variance = segment.size_variance;
  const double along = 0.5 * segment.size_variance;
  const TPoint2D n = directionVector(segment);
  const auto& p = segment.position_covariance;
  const double across = n.x * n.x * p(0, 0) + 2 * n.x * n.y * p(0, 1) + n.y * n.y * p(1, 1) +
                        0.25 * segment.size * segment.size * segment.direction_variance;
  end.position_covariance(0, 0) = across * n.x * n.x + along * tangent.x * tangent.x;
  end.position_covariance(1, 1) = across * n.y * n.y + along * tangent.y * tangent.y;
  end.position_covariance(0, 1) = end.position_covariance(1, 0) =
      across * n.x * n.y + along * tangent.x * tangent.y;
  end.parent = parent;
  return end;
}

/// Segments with the ranges of returns they were fitted to, in scan order.
struct FittedSegments
{
  std::vector<Feature> features;
  std::vector<PointRange> ranges;
};

void addSegmentsOfCluster(const ScanPoints& scan, PointRange cluster, double range_sigma,
                          const FeatureExtractorOptions& options, FittedSegments& out)
{
  std::vector<PointRange> pieces;
  splitRange(scan, cluster, options, pieces);
  for (const PointRange& piece : rejoined(scan, pieces, options))
  {
    const std::size_t count = piece.last - piece.first + 1;
    const double length = (scan.points[piece.last] - scan.points[piece.first]).norm();
    if (count < options.min_segment_points || length < options.min_segment_length) continue;
    Feature segment = makeSegment(scan, piece, range_sigma);
    segment.start_seen = jumpsFarther(scan, piece.first, -1, options);
    segment.end_seen = jumpsFarther(scan, piece.last, +1, options);
    out.features.push_back(segment);
    out.ranges.push_back(piece);
  }
}

/// The circles and segments of the clusters of a scan.
struct FittedClusters
{
  std::vector<Feature> circles;
  FittedSegments segments;
  bool has_sky = false;  ///< a circle has the sky beside it
};

FittedClusters fitClusters(const ScanPoints& scan, double range_sigma, Background background,
                           const FeatureExtractorOptions& options)
{
  FittedClusters fitted;
  for (const PointRange& cluster : clustersOf(scan, options))
  {
    if (auto circle = makeCircle(scan, cluster, range_sigma, background, options))
    {
      fitted.circles.push_back(*circle);
      fitted.has_sky |= !standsAlone(scan, cluster, Background::farther, options);
      continue;  // not split into segments, so that its returns count once
    }
    addSegmentsOfCluster(scan, cluster, range_sigma, options, fitted.segments);
  }
  return fitted;
}

/// Returns all features of one scan in the sensor frame. Derived ones have the indices of their
/// parent segments.
std::vector<Feature> featuresOfScan(const ScanPoints& scan, double range_sigma,
                                    const FeatureExtractorOptions& options)
{
  // In the open there are only posts with the sky between them. Beside buildings, something before
  // the sky may also be a bush or the end of the laser's range.
  FittedClusters fitted = fitClusters(scan, range_sigma, Background::farther_or_sky, options);
  if (fitted.has_sky && !fitted.segments.features.empty())
  {
    fitted = fitClusters(scan, range_sigma, Background::farther, options);
  }
  std::vector<Feature>& circles = fitted.circles;
  FittedSegments& segments = fitted.segments;

  std::vector<Feature> derived;
  const std::size_t count = segments.features.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const bool at_seam = i + 1 == count;
    if (at_seam && (!scan.closed || count < 2)) continue;
    const std::size_t next = at_seam ? 0 : i + 1;
    const std::size_t first = segments.ranges[next].first + (at_seam ? scan.points.size() : 0);
    if (first > segments.ranges[i].last + 3) continue;
    if (auto corner = makeCorner(segments.features[i], segments.features[next], options))
    {
      corner->parent = static_cast<std::int32_t>(i);
      derived.push_back(*corner);
    }
  }
  for (std::size_t i = 0; i < segments.features.size(); ++i)
  {
    const Feature& segment = segments.features[i];
    const auto parent = static_cast<std::int32_t>(i);
    if (segment.start_seen) derived.push_back(makeWallEnd(segment, WallSide::start, parent));
    if (segment.end_seen) derived.push_back(makeWallEnd(segment, WallSide::end, parent));
  }

  std::vector<Feature> features = std::move(segments.features);
  features.insert(features.end(), circles.begin(), circles.end());
  features.insert(features.end(), derived.begin(), derived.end());
  return features;
}

void checkScan(const LaserScan& scan)
{
  if (scan.ranges.size() != scan.valid.size())
  {
    throw std::invalid_argument("observeScene: ranges and valid differ in size");
  }
  if (!(scan.angle_step > 0))
  {
    throw std::invalid_argument("observeScene: the angle step must be positive");
  }
}
/// Returns the options with thresholds that noise alone does not exceed: 3 sigma from a line, 4.2
/// sigma (6 of one range) between two returns. Up to 2 cm of noise they stay as configured.
FeatureExtractorOptions thresholdsFor(double range_sigma, FeatureExtractorOptions options)
{
  options.split_distance = std::max(options.split_distance, 3 * range_sigma);
  options.break_distance = std::max(options.break_distance, 6 * range_sigma);
  options.wall_end_jump = std::max(options.wall_end_jump, 6 * range_sigma);
  return options;
}
}  // namespace

void appendScan(ScanPoints scan, const mrpt::math::TPose2D& robot_from_sensor, double range_sigma,
                const FeatureExtractorOptions& configured, ObservedScene& scene)
{
  const FeatureExtractorOptions options = thresholdsFor(range_sigma, configured);
  // The second pass finds speckles that others have hidden in the first.
  for (int pass = 0; pass < 2; ++pass) dropSpeckles(scan, options);
  startAtBreak(scan, options);

  const auto origin = static_cast<std::uint32_t>(scene.sensor_origins.size());
  scene.sensor_origins.emplace_back(robot_from_sensor.x, robot_from_sensor.y);
  // composePoint() would compute the sine and cosine of the heading for every beam.
  const double c = std::cos(robot_from_sensor.phi);
  const double s = std::sin(robot_from_sensor.phi);
  scene.beams.reserve(scene.beams.size() + scan.points.size());
  for (const TPoint2D& p : scan.points)
  {
    scene.beams.push_back(
        {{robot_from_sensor.x + c * p.x - s * p.y, robot_from_sensor.y + s * p.x + c * p.y},
         origin});
  }
  const auto first_feature = static_cast<std::int32_t>(scene.features.size());
  for (Feature feature : featuresOfScan(scan, std::max(range_sigma, 0.001), options))
  {
    if (feature.parent >= 0) feature.parent += first_feature;
    scene.features.push_back(transformed(robot_from_sensor, feature));
  }
}

ObservedScene observeScene(const std::vector<LaserScan>& scans,
                           const FeatureExtractorOptions& options)
{
  ObservedScene scene;
  for (const LaserScan& scan : scans)
  {
    checkScan(scan);
    appendScan(validPoints(scan, options), scan.robot_from_sensor, scan.range_sigma, options,
               scene);
  }
  return scene;
}
}  // namespace sigloc
