// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "signature/binary_constraint.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
double square(double value)
{
  return value * value;
}

/// Returns the signed distance of a place to a line. Its variance includes the line's angle error
/// over the lever arm.
BinaryKey distanceToLine(const DirectedFeature& line, const DirectedFeature& place)
{
  const TPoint2D between = place.position() - line.position();
  const double lever = dot(between, line.tangent());
  return {dot(between, line.normal),
          varianceAlong(*line.feature, line.normal) + varianceAlong(*place.feature, line.normal) +
              square(lever) * line.feature->direction_variance,
          false};
}

/// Returns the bearing of `other` in the frame of a directed place.
BinaryKey bearingFrom(const DirectedFeature& corner, const DirectedFeature& other)
{
  const TPoint2D between = other.position() - corner.position();
  const double squared = std::max(dot(between, between), 1e-6);
  const TPoint2D across{-between.y / std::sqrt(squared), between.x / std::sqrt(squared)};
  const double spread =
      varianceAlong(*corner.feature, across) + varianceAlong(*other.feature, across);
  return {std::atan2(cross(corner.normal, between), dot(corner.normal, between)),
          corner.feature->direction_variance + spread / squared, true};
}

bool keysAgree(const BinaryKey& observed, const BinaryKey& mapped, double relative_sigma,
               double gate)
{
  const double difference = observed.is_angle ? mrpt::math::wrapToPi(observed.value - mapped.value)
                                              : observed.value - mapped.value;
  return square(difference) <=
         gate * (observed.variance + mapped.variance + square(relative_sigma) + kRoundingVariance);
}

double squaredSeparation(const DirectedFeature& a, const DirectedFeature& b)
{
  const TPoint2D between = b.position() - a.position();
  return dot(between, between);
}

/// Returns the angle [rad] by which the map's relative error changes a bearing.
double relativeAngle(const DirectedFeature& a, const DirectedFeature& b, const MapErrorModel& error)
{
  const double distance = std::sqrt(std::max(squaredSeparation(a, b), 1e-6));
  return error.relativeSigma(distance) / distance;
}

/// The shifts along the mapped wall that keep at least a share of the observed piece on it.
struct ShiftRange
{
  double low;
  double high;
};

ShiftRange shiftsOnto(double observed_low, double observed_high, double mapped_low,
                      double mapped_high, double min_overlap, double tolerance)
{
  const double needed =
      min_overlap * std::min(observed_high - observed_low, mapped_high - mapped_low);
  return {mapped_low - observed_high + needed - tolerance,
          mapped_high - observed_low - needed + tolerance};
}

bool bearingsAgree(const DirectedFeature& observed_first, const DirectedFeature& observed_second,
                   const DirectedFeature& mapped_first, const DirectedFeature& mapped_second,
                   const MapErrorModel& error, double gate)
{
  const double bend = relativeAngle(mapped_first, mapped_second, error);
  const bool first_agrees = !hasBearing(observed_first.type()) ||
                            keysAgree(bearingFrom(observed_first, observed_second),
                                      bearingFrom(mapped_first, mapped_second), bend, gate);
  return first_agrees && (!hasBearing(observed_second.type()) ||
                          keysAgree(bearingFrom(observed_second, observed_first),
                                    bearingFrom(mapped_second, mapped_first), bend, gate));
}

/// Tests a place beside a wall. The observed piece, measured from the foot of the place, must
/// overlap the mapped stretch. A corner's direction must also make the same angle with the wall.
bool placeBesideWall(const DirectedFeature& observed_wall, const DirectedFeature& observed_place,
                     const DirectedFeature& mapped_wall, const DirectedFeature& mapped_place,
                     const MapErrorModel& error, const BinaryGates& gates)
{
  if (hasBearing(observed_place.type()))
  {
    const auto angle = [](const DirectedFeature& wall, const DirectedFeature& place)
    {
      return BinaryKey{std::atan2(cross(wall.normal, place.normal), dot(wall.normal, place.normal)),
                       wall.feature->direction_variance + place.feature->direction_variance, true};
    };
    if (!keysAgree(angle(observed_wall, observed_place), angle(mapped_wall, mapped_place), 0,
                   gates.scalar))
    {
      return false;
    }
  }
  const auto foot = [](const DirectedFeature& wall, const DirectedFeature& place)
  { return dot(place.position() - wall.position(), wall.tangent()); };
  const double foot_observed = foot(observed_wall, observed_place);
  const double foot_mapped = foot(mapped_wall, mapped_place);
  const double distance = std::sqrt(squaredSeparation(mapped_wall, mapped_place));
  const double variance = varianceAlong(*observed_wall.feature, observed_wall.tangent()) +
                          varianceAlong(*mapped_wall.feature, mapped_wall.tangent()) +
                          varianceAlong(*observed_place.feature, observed_wall.tangent()) +
                          varianceAlong(*mapped_place.feature, mapped_wall.tangent()) +
                          square(error.relativeSigma(distance));
  const ShiftRange range =
      shiftsOnto(observed_wall.start - foot_observed, observed_wall.end - foot_observed,
                 mapped_wall.start - foot_mapped, mapped_wall.end - foot_mapped, gates.min_overlap,
                 std::sqrt(gates.scalar * variance));
  return range.low <= 0 && range.high >= 0;
}

/// Tests two nearly parallel walls. They must have the same signed offset, and one common slide
/// must keep both pieces on their mapped walls. Eq. (3.6)
bool parallelWallsAgree(const DirectedFeature& observed_first,
                        const DirectedFeature& observed_second, const DirectedFeature& mapped_first,
                        const DirectedFeature& mapped_second, const MapErrorModel& error,
                        const BinaryGates& gates)
{
  // The offset changes along walls that are not quite parallel. So both are measured at the
  // observed piece, slid to the middle of its mapped wall.
  BinaryKey observed_offset = distanceToLine(observed_first, observed_second);
  BinaryKey mapped_offset = distanceToLine(mapped_first, mapped_second);
  const double slope = std::abs(cross(mapped_first.normal, mapped_second.normal));
  const double slack = 0.5 * slope * std::max(mapped_first.length(), mapped_second.length());
  const double distance = std::abs(mapped_offset.value);
  const double relative = error.relativeSigma(distance) + slack;
  if (!keysAgree(observed_offset, mapped_offset, relative, gates.scalar)) return false;

  const auto along = [](const DirectedFeature& first, const DirectedFeature& second)
  {
    const double at = dot(second.position() - first.position(), first.tangent());
    const double way = dot(second.tangent(), first.tangent()) > 0 ? 1.0 : -1.0;
    const double a = at + way * second.start;
    const double b = at + way * second.end;
    return ShiftRange{std::min(a, b), std::max(a, b)};
  };
  const ShiftRange seen = along(observed_first, observed_second);
  const ShiftRange known = along(mapped_first, mapped_second);
  const double variance = varianceAlong(*observed_first.feature, observed_first.tangent()) +
                          varianceAlong(*mapped_first.feature, mapped_first.tangent()) +
                          square(relative);
  const double tolerance = std::sqrt(gates.scalar * variance);
  const ShiftRange first = shiftsOnto(observed_first.start, observed_first.end, mapped_first.start,
                                      mapped_first.end, gates.min_overlap, tolerance);
  const ShiftRange second =
      shiftsOnto(seen.low, seen.high, known.low, known.high, gates.min_overlap, tolerance);
  return std::max(first.low, second.low) <= std::min(first.high, second.high);
}

/// Tests two walls that are not parallel. Measured from the point where their lines cross, each
/// observed piece must overlap its mapped wall. No pose is needed. Eq. (3.7)
bool crossingWallsAgree(const DirectedFeature& observed_first,
                        const DirectedFeature& observed_second, const DirectedFeature& mapped_first,
                        const DirectedFeature& mapped_second, const MapErrorModel& error,
                        const BinaryGates& gates)
{
  const auto crossing = [](const DirectedFeature& first, const DirectedFeature& second)
  {
    // The position along the first wall's tangent where it meets the second wall's line.
    const double offset = dot(second.position() - first.position(), second.normal);
    return offset / dot(first.tangent(), second.normal);
  };
  const double sine = std::abs(cross(observed_first.normal, observed_second.normal));
  const auto overlaps = [&](const DirectedFeature& observed, const DirectedFeature& other_observed,
                            const DirectedFeature& mapped, const DirectedFeature& other_mapped)
  {
    const double seen = crossing(observed, other_observed);
    const double known = crossing(mapped, other_mapped);
    // The crossing moves by the other wall's offset error over the sine, and by angle errors over
    // the lever arms.
    const double lever =
        std::abs(dot(other_observed.position() - observed.position(), other_observed.tangent()));
    const double angle =
        observed.feature->direction_variance + other_observed.feature->direction_variance +
        mapped.feature->direction_variance + other_mapped.feature->direction_variance;
    const double across = varianceAlong(*other_observed.feature, other_observed.normal) +
                          varianceAlong(*other_mapped.feature, other_mapped.normal) +
                          varianceAlong(*observed.feature, observed.normal) +
                          varianceAlong(*mapped.feature, mapped.normal);
    const double variance = (across + (square(lever) + square(seen)) * angle) / square(sine) +
                            varianceAlong(*observed.feature, observed.tangent()) +
                            varianceAlong(*mapped.feature, mapped.tangent()) +
                            square(error.relativeSigma(std::abs(seen)));
    const ShiftRange range =
        shiftsOnto(observed.start - seen, observed.end - seen, mapped.start - known,
                   mapped.end - known, gates.min_overlap, std::sqrt(gates.scalar * variance));
    return range.low <= 0 && range.high >= 0;
  };
  return overlaps(observed_first, observed_second, mapped_first, mapped_second) &&
         overlaps(observed_second, observed_first, mapped_second, mapped_first);
}
}  // namespace

BinaryKey binaryKey(const DirectedFeature& first, const DirectedFeature& second)
{
  const bool first_wall = isSegment(first.type());
  const bool second_wall = isSegment(second.type());
  if (first_wall && second_wall)
  {
    return {std::atan2(cross(first.normal, second.normal), dot(first.normal, second.normal)),
            first.feature->direction_variance + second.feature->direction_variance, true};
  }
  if (first_wall) return distanceToLine(first, second);
  if (second_wall) return distanceToLine(second, first);
  const TPoint2D between = second.position() - first.position();
  const double distance = std::hypot(between.x, between.y);
  const TPoint2D unit = distance > 0 ? between * (1 / distance) : TPoint2D{1, 0};
  return {distance, varianceAlong(*first.feature, unit) + varianceAlong(*second.feature, unit),
          false};
}

double keyTolerance(const BinaryKey& observed, double mapped_variance, const MapErrorModel& error,
                    double gate)
{
  const double relative = observed.is_angle ? 0 : error.relativeSigma(std::abs(observed.value));
  // The map's relative error is that at the observed distance. Adding the slope once more covers
  // its small growth within the gate.
  const double width = std::sqrt(
      gate * (observed.variance + mapped_variance + square(relative) + kRoundingVariance));
  return observed.is_angle ? width : width * (1 + 2 * error.relative_slope);
}

bool binaryCompatible(const DirectedFeature& observed_first, const DirectedFeature& observed_second,
                      const DirectedFeature& mapped_first, const DirectedFeature& mapped_second,
                      const MapErrorModel& error, const BinaryGates& gates)
{
  const BinaryKey observed = binaryKey(observed_first, observed_second);
  const BinaryKey mapped = binaryKey(mapped_first, mapped_second);
  const double relative = observed.is_angle ? 0 : error.relativeSigma(std::abs(mapped.value));
  if (!keysAgree(observed, mapped, relative, gates.scalar)) return false;

  const bool first_wall = isSegment(observed_first.type());
  const bool second_wall = isSegment(observed_second.type());
  if (first_wall && second_wall)
  {
    const bool parallel =
        std::abs(cross(observed_first.normal, observed_second.normal)) < kParallelSine;
    return parallel ? parallelWallsAgree(observed_first, observed_second, mapped_first,
                                         mapped_second, error, gates)
                    : crossingWallsAgree(observed_first, observed_second, mapped_first,
                                         mapped_second, error, gates);
  }
  if (first_wall)
  {
    return placeBesideWall(observed_first, observed_second, mapped_first, mapped_second, error,
                           gates);
  }
  if (second_wall)
  {
    return placeBesideWall(observed_second, observed_first, mapped_second, mapped_first, error,
                           gates);
  }
  return bearingsAgree(observed_first, observed_second, mapped_first, mapped_second, error,
                       gates.scalar);
}
}  // namespace sigloc
