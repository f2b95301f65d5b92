// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "signature/pose_fit.h"

#include "signature/binary_constraint.h"
#include "signature/location_constraint.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
struct NormalEquations
{
  Symmetric3 information;
  std::array<double, 3> vector{};
};

NormalEquations normalEquations(const PoseEstimate& pose, const DirectedPairing* begin,
                                const DirectedPairing* end, double relative_sigma, bool slide)
{
  NormalEquations sum;
  for (const DirectedPairing* pairing = begin; pairing != end; ++pairing)
  {
    const auto& [observed, mapped] = *pairing;
    addInformation(placeMeasurement(pose, observed, mapped, relative_sigma), sum.information,
                   sum.vector);
    if (hasBearing(observed.type()))
    {
      addInformation(directionMeasurement(pose, observed, mapped), sum.information, sum.vector);
    }
    if (slide && isSegment(observed.type()))
    {
      addInformation(slideMeasurement(pose, observed, mapped), sum.information, sum.vector);
    }
  }
  return sum;
}

/// True when the pairings leave a direction of the plane open: the information about the position,
/// with the heading marginalised, vanishes along it.
bool leavesDirectionOpen(const Symmetric3& information)
{
  if (!(information.tt > 0)) return true;
  const double xx = information.xx - information.xt * information.xt / information.tt;
  const double xy = information.xy - information.xt * information.yt / information.tt;
  const double yy = information.yy - information.yt * information.yt / information.tt;
  const double mean = 0.5 * (xx + yy);
  const double smallest = mean - std::hypot(0.5 * (xx - yy), xy);
  constexpr double kOpenSigma = 3.0;  // [m] from which a direction is open, the width of a room
  return smallest < 1 / (kOpenSigma * kOpenSigma);
}

std::optional<PoseEstimate> iterate(PoseEstimate pose, const DirectedPairing* begin,
                                    const DirectedPairing* end, double relative_sigma,
                                    int iterations)
{
  for (int k = 0; k < iterations; ++k)
  {
    NormalEquations sum = normalEquations(pose, begin, end, relative_sigma, false);
    if (leavesDirectionOpen(sum.information))
    {
      sum = normalEquations(pose, begin, end, relative_sigma, true);
    }
    const auto covariance = inverse(sum.information);
    if (!covariance) return std::nullopt;
    const auto& [vx, vy, vt] = sum.vector;
    pose.x += covariance->xx * vx + covariance->xy * vy + covariance->xt * vt;
    pose.y += covariance->xy * vx + covariance->yy * vy + covariance->yt * vt;
    pose.setHeading(pose.heading + covariance->xt * vx + covariance->yt * vy + covariance->tt * vt);
    pose.covariance = *covariance;
  }
  return pose;
}

double headingOf(const DirectedPairing& pairing)
{
  return mrpt::math::wrapToPi(pairing.mapped.feature->direction -
                              pairing.observed.feature->direction);
}

/// Moves the pose, with its heading given, so that the observed place is at the mapped one.
void putOnto(PoseEstimate& pose, const DirectedPairing& pairing)
{
  const TPoint2D arm = pose.turn(pairing.observed.position());
  pose.x = pairing.mapped.position().x - arm.x;
  pose.y = pairing.mapped.position().y - arm.y;
}

std::optional<PoseEstimate> fromTwoPlaces(const DirectedPairing& first,
                                          const DirectedPairing& second)
{
  const TPoint2D seen = second.observed.position() - first.observed.position();
  const TPoint2D known = second.mapped.position() - first.mapped.position();
  // Eq. (5.1): the turn that takes one connecting vector into the other.
  const double along = dot(seen, known);
  const double across = cross(seen, known);
  constexpr double kCoincident = 1e-9;  // [m^2]
  PoseEstimate pose;
  if (dot(seen, seen) > kCoincident && dot(known, known) > kCoincident)
  {
    pose.setHeading(std::atan2(across, along));
  }
  else if (hasBearing(first.observed.type()))
  {
    pose.setHeading(headingOf(first));
  }
  else if (hasBearing(second.observed.type()))
  {
    pose.setHeading(headingOf(second));
  }
  else
  {
    return std::nullopt;
  }
  const TPoint2D a = pose.turn(first.observed.position());
  const TPoint2D b = pose.turn(second.observed.position());
  pose.x = 0.5 * (first.mapped.position().x + second.mapped.position().x - a.x - b.x);
  pose.y = 0.5 * (first.mapped.position().y + second.mapped.position().y - a.y - b.y);
  return pose;
}

std::optional<PoseEstimate> fromTwoWalls(const DirectedPairing& first,
                                         const DirectedPairing& second)
{
  // Eq. (5.2): the heading from both angles, each by its own certainty.
  const auto certainty = [](const DirectedPairing& pairing)
  {
    return 1 / (pairing.observed.feature->direction_variance +
                pairing.mapped.feature->direction_variance + 1e-12);
  };
  const double share = certainty(second) / (certainty(first) + certainty(second));
  const double difference = mrpt::math::wrapToPi(headingOf(second) - headingOf(first));
  PoseEstimate pose;
  pose.setHeading(headingOf(first) + share * difference);

  // Eq. (5.3): both offsets, a 2x2 system over the position.
  const TPoint2D& n = first.mapped.normal;
  const TPoint2D& q = second.mapped.normal;
  const double sine = cross(n, q);
  putOnto(pose, first);
  if (std::abs(sine) < kParallelSine)
  {
    // Only the position across the walls is known, so slide to the middle of the first mapped
    // stretch.
    const double middle = 0.5 * (first.mapped.start + first.mapped.end);
    pose.x += middle * first.mapped.tangent().x;
    pose.y += middle * first.mapped.tangent().y;
    return pose;
  }
  const double missing = dot(second.mapped.position() - pose.place(second.observed.position()), q);
  const double slide = missing / dot(first.mapped.tangent(), q);
  pose.x += slide * first.mapped.tangent().x;
  pose.y += slide * first.mapped.tangent().y;
  return pose;
}

std::optional<PoseEstimate> fromPlaceAndWall(const DirectedPairing& place,
                                             const DirectedPairing& wall)
{
  // Eq. (5.4): the wall gives the heading, the place the position.
  PoseEstimate pose;
  pose.setHeading(headingOf(wall));
  putOnto(pose, place);
  return pose;
}
}  // namespace

std::optional<PoseEstimate> poseFromBase(const DirectedPairing& first,
                                         const DirectedPairing& second, double relative_sigma)
{
  const bool first_wall = isSegment(first.observed.type());
  const bool second_wall = isSegment(second.observed.type());
  std::optional<PoseEstimate> pose;
  if (first_wall && second_wall)
  {
    pose = fromTwoWalls(first, second);
  }
  else if (first_wall)
  {
    pose = fromPlaceAndWall(second, first);
  }
  else
  {
    pose = second_wall ? fromPlaceAndWall(first, second) : fromTwoPlaces(first, second);
  }
  if (!pose) return std::nullopt;
  const std::array<DirectedPairing, 2> both{first, second};
  return iterate(*pose, both.data(), both.data() + both.size(), relative_sigma, 1);
}

std::optional<PoseEstimate> poseFromPlaces(const TPoint2D* observed, const TPoint2D* mapped,
                                           std::size_t count, double variance)
{
  const double share = 1 / static_cast<double>(count);
  TPoint2D centre{0, 0};
  TPoint2D target{0, 0};
  for (std::size_t k = 0; k < count; ++k)
  {
    centre = centre + observed[k] * share;
    target = target + mapped[k] * share;
  }
  double along = 0;
  double across = 0;
  double spread = 0;
  for (std::size_t k = 0; k < count; ++k)
  {
    const TPoint2D seen = observed[k] - centre;
    const TPoint2D known = mapped[k] - target;
    along += dot(seen, known);
    across += cross(seen, known);
    spread += dot(seen, seen);
  }
  const double norm = std::sqrt(along * along + across * across);
  constexpr double kCoincident = 1e-9;  // [m^2]
  if (!(norm > kCoincident) || !(spread > kCoincident)) return std::nullopt;

  PoseEstimate pose;
  pose.heading = std::atan2(across, along);
  pose.c = along / norm;
  pose.s = across / norm;
  const TPoint2D arm = pose.turn(centre);
  pose.x = target.x - arm.x;
  pose.y = target.y - arm.y;
  // The centre has the variance / count, the heading the variance / spread. The arm from the robot
  // to the centre turns the heading's error into one of the position.
  const double tt = variance / spread;
  pose.covariance = {variance * share + arm.y * arm.y * tt, -arm.x * arm.y * tt, arm.y * tt,
                     variance * share + arm.x * arm.x * tt, -arm.x * tt,         tt};
  return pose;
}

std::optional<PoseEstimate> refinePose(const PoseEstimate& start,
                                       const std::vector<DirectedPairing>& pairings,
                                       double relative_sigma, int iterations)
{
  return iterate(start, pairings.data(), pairings.data() + pairings.size(), relative_sigma,
                 iterations);
}
}  // namespace sigloc
