// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/LocalMap.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "geometry/chi_square.h"
#include "geometry/PoseEstimate.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
/// Returns a feature of the previous robot frame in the current one, with the motion's uncertainty
/// added.
Feature moved(const MotionIncrement& previous_from_current, const Feature& feature)
{
  const TPose2D& motion = previous_from_current.mean;
  Feature out = transformed(TPose2D(0, 0, 0) - motion, feature);
  const double c = std::cos(motion.phi);
  const double s = std::sin(motion.phi);
  // p' = R' (p - t): the shift enters turned back, the turn enters over the lever arm.
  const Symmetric3 q = toSymmetric(previous_from_current.covariance);
  const Symmetric2 shift = rotated({q.xx, q.xy, q.yy}, c, -s);
  const double along_x = -(c * q.xt + s * q.yt);
  const double along_y = -(-s * q.xt + c * q.yt);
  const TPoint2D turn{out.position.y, -out.position.x};
  auto& p = out.position_covariance;
  p(0, 0) += shift.xx + turn.x * turn.x * q.tt + 2 * turn.x * along_x;
  p(1, 1) += shift.yy + turn.y * turn.y * q.tt + 2 * turn.y * along_y;
  const double mixed = shift.xy + turn.x * turn.y * q.tt + turn.x * along_y + turn.y * along_x;
  p(0, 1) += mixed;
  p(1, 0) += mixed;
  if (hasDirection(feature.type)) out.direction_variance += q.tt;
  return out;
}

Symmetric2 sum(const Feature& a, const Feature& b)
{
  const auto& p = a.position_covariance;
  const auto& q = b.position_covariance;
  constexpr double kRounding = 1e-12;  // [m^2]
  return {p(0, 0) + q(0, 0) + kRounding, p(0, 1) + q(0, 1), p(1, 1) + q(1, 1) + kRounding};
}

void widen(Feature& feature, double variance)
{
  feature.position_covariance(0, 0) += variance;
  feature.position_covariance(1, 1) += variance;
}

/// Fuses a new sighting into a gathered feature by their covariances.
void fuse(Feature& gathered, const Feature& seen)
{
  const Symmetric2 s = sum(gathered, seen);
  const double scale = 1 / determinant(s);
  auto& p = gathered.position_covariance;
  const double g00 = (p(0, 0) * s.yy - p(0, 1) * s.xy) * scale;
  const double g01 = (p(0, 1) * s.xx - p(0, 0) * s.xy) * scale;
  const double g10 = (p(0, 1) * s.yy - p(1, 1) * s.xy) * scale;
  const double g11 = (p(1, 1) * s.xx - p(0, 1) * s.xy) * scale;
  const TPoint2D off = seen.position - gathered.position;
  gathered.position = {gathered.position.x + g00 * off.x + g01 * off.y,
                       gathered.position.y + g10 * off.x + g11 * off.y};
  const double xx = p(0, 0) - g00 * p(0, 0) - g01 * p(0, 1);
  const double xy = p(0, 1) - g00 * p(0, 1) - g01 * p(1, 1);
  const double yy = p(1, 1) - g10 * p(0, 1) - g11 * p(1, 1);
  p(0, 0) = xx;
  p(0, 1) = p(1, 0) = xy;
  p(1, 1) = yy;
  const auto scalar = [](double& mean, double& variance, double value, double value_variance)
  {
    const double share = variance / std::max(1e-12, variance + value_variance);
    mean += share * value;
    variance *= 1 - share;
  };
  scalar(gathered.direction, gathered.direction_variance,
         mrpt::math::wrapToPi(seen.direction - gathered.direction), seen.direction_variance);
  scalar(gathered.size, gathered.size_variance, seen.size - gathered.size, seen.size_variance);
  gathered.direction = mrpt::math::wrapToPi(gathered.direction);
  gathered.sightings += 1;
}
}  // namespace

LocalMap::LocalMap(const LocalMapOptions& options)
    : options_(options), gate_(chiSquareGate(options.gate_probability, 2))
{
  checkOptions(options);
}

Feature LocalMap::widened(const Feature& seen) const
{
  // The centre fitted to a trunk's near side shifts towards the side from which it is seen. The
  // shift is the same in every scan, so averaging does not remove it.
  Feature feature = seen;
  const double radius = isRound(seen.type) ? seen.size : 0.0;
  widen(feature,
        options_.place_sigma * options_.place_sigma + std::pow(options_.radius_share * radius, 2));
  return feature;
}

void LocalMap::forget()
{
  std::size_t kept = 0;
  for (std::size_t k = 0; k < places_.size(); ++k)
  {
    const bool too_far = places_[k].position.norm() > options_.max_distance;
    const bool seen_once = places_[k].sightings <= 1 && steps_ > born_[k] + options_.forget_after;
    if (too_far || seen_once) continue;
    places_[kept] = places_[k];
    born_[kept++] = born_[k];
  }
  places_.resize(kept);
  born_.resize(kept);
}

std::vector<LocalMap::Match> LocalMap::associate(const MotionIncrement& motion,
                                                 const std::vector<Feature>& observed) const
{
  std::vector<Match> all;
  for (std::size_t g = 0; g < places_.size(); ++g)
  {
    const Feature expected = moved(motion, places_[g]);
    for (std::size_t o = 0; o < observed.size(); ++o)
    {
      if (observed[o].type != expected.type || observed[o].label != expected.label) continue;
      const TPoint2D off = observed[o].position - expected.position;
      const double distance = squaredNorm(off.x, off.y, sum(expected, observed[o]));
      if (distance <= gate_) all.push_back({g, o, distance});
    }
  }
  std::sort(all.begin(), all.end(),
            [](const Match& a, const Match& b) { return a.squared_distance < b.squared_distance; });
  std::vector<Match> matches;
  for (const Match& match : all)
  {
    const bool taken = std::any_of(
        matches.begin(), matches.end(),
        [&](const Match& other)
        { return other.gathered == match.gathered || other.observed == match.observed; });
    if (!taken) matches.push_back(match);
  }
  return matches;
}

MotionIncrement LocalMap::corrected(const MotionIncrement& motion,
                                    const std::vector<Feature>& observed,
                                    const std::vector<Match>& matches) const
{
  PoseEstimate estimate = toEstimate({motion.mean, motion.covariance});
  for (const Match& match : matches)
  {
    const Feature& known = places_[match.gathered];
    const Feature& seen = observed[match.observed];
    const TPoint2D arm = estimate.turn(seen.position);
    const auto& p = seen.position_covariance;
    const auto& q = known.position_covariance;
    const Symmetric2 noise = rotated({p(0, 0), p(0, 1), p(1, 1)}, estimate.c, estimate.s);
    PlanarMeasurement m;
    m.residual = {known.position.x - estimate.x - arm.x, known.position.y - estimate.y - arm.y};
    m.jacobian = {{{1, 0, -arm.y}, {0, 1, arm.x}}};
    m.noise = {noise.xx + q(0, 0) + 1e-12, noise.xy + q(0, 1), noise.yy + q(1, 1) + 1e-12};
    update(estimate, m);
  }
  const GaussianPose pose = toGaussian(estimate);
  return {pose.mean, pose.covariance};
}

void LocalMap::add(const MotionIncrement& motion, const std::vector<Feature>& observed)
{
  std::vector<Feature> seen;
  segments_.clear();
  for (const Feature& feature : observed)
  {
    const bool is_place = isPointLike(feature.type);
    (is_place ? seen : segments_).push_back(is_place ? widened(feature) : feature);
    Feature& last = is_place ? seen.back() : segments_.back();
    last.parent = -1;  // the features that it is derived from are not kept
    last.sightings = 1;
  }
  MotionIncrement best = motion;
  if (places_.empty()) best.covariance.setZero();  // no older features that the motion could move
  std::vector<Match> matches = associate(best, seen);
  if (!matches.empty())
  {
    best = corrected(best, seen, matches);
    matches = associate(best, seen);
  }
  for (Feature& place : places_) place = moved(best, place);

  std::vector<bool> known(seen.size(), false);
  constexpr double kLasting = 0.3;  // share of the wandering that is the same as in the last scan
  for (const Match& match : matches)
  {
    known[match.observed] = true;
    Feature& place = places_[match.gathered];
    fuse(place, seen[match.observed]);
    const double radius = isRound(place.type) ? place.size : 0.0;
    widen(place, std::pow(kLasting * options_.place_sigma, 2) +
                     std::pow(kLasting * options_.radius_share * radius, 2));
  }
  for (std::size_t o = 0; o < seen.size(); ++o)
  {
    if (known[o]) continue;
    places_.push_back(seen[o]);
    born_.push_back(steps_);
  }
  if (steps_ > 0) travelled_ += std::hypot(motion.mean.x, motion.mean.y);
  ++steps_;
  forget();
}

std::vector<Feature> LocalMap::features(std::uint32_t min_sightings) const
{
  std::vector<Feature> out = segments_;
  for (const Feature& place : places_)
  {
    if (place.sightings >= min_sightings) out.push_back(place);
  }
  return out;
}
}  // namespace sigloc
