// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map_check.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <random>
#include <stdexcept>

#include "FreeSpaceGrid.h"
#include "sigloc/features/observe_scans.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/HypothesisTracker.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kAlike = 0.3;  // a wrong candidate that scores no less than this below the first
constexpr double kAlongError = 0.05;  // of odometry, share of a step
constexpr double kTurnError = 0.02;  // [rad] in a step
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Random numbers that are the same with every standard library.
class Noise
{
 public:
  explicit Noise(std::uint64_t seed) : engine_(seed) {}
  /// In [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }
  /// Uniform, with mean 0 and standard deviation 1.
  double spread() { return std::sqrt(12.0) * (uniform() - 0.5); }
  std::uint64_t seed() { return engine_(); }

 private:
  std::mt19937_64 engine_;
};

class Checker
{
 public:
  Checker(std::shared_ptr<const FeatureMap> map, const SimulatedLaserOptions& laser,
          std::uint32_t seed)
      : matcher_(std::make_shared<const SignatureMatcher>(map)),
        simulator_(*map->field(), laser),
        noise_(seed)
  {
  }

  CheckedPlace ask(const TPose2D& pose, std::uint32_t scans, bool any_heading)
  {
    CheckedPlace place;
    place.pose = pose;
    place.scans = scans;
    for (std::uint32_t k = 0; k < scans; ++k)
    {
      TPose2D truth = pose;
      if (any_heading) truth.phi = 2 * M_PI * (k + noise_.uniform()) / scans - M_PI;
      askOnce(truth, place);
    }
    return place;
  }

  /// How far the robot drives until it is localized at the right pose [m]; infinite: farther.
  double driveFrom(const FreeSpaceGrid& space, const TPoint2D& place)
  {
    HypothesisTracker tracker(matcher_);
    double travelled = 0;
    std::optional<TPose2D> before;
    for (const TPose2D& pose : space.drive(place, MapCheck::kDrive, noise_.seed()))
    {
      std::optional<MotionIncrement> motion;
      if (before)
      {
        motion = odometry(pose - *before);
        travelled += std::hypot(pose.x - before->x, pose.y - before->y);
      }
      before = pose;
      const Belief& belief = tracker.step(motion, scene(pose));
      if (belief.verdict == Verdict::localized &&
          isRight(errorBetween(belief.hypotheses.front().pose.mean, pose)))
        return travelled;
    }
    return kInfinity;
  }

  std::vector<Confusion> confusions;
  std::vector<double> times_ms;

 private:
  ObservedScene scene(const TPose2D& pose)
  {
    return observeScene({simulator_.scan(pose, noise_.seed())});
  }

  void askOnce(const TPose2D& truth, CheckedPlace& place)
  {
    const LaserScan scan = simulator_.scan(truth, noise_.seed());
    const std::clock_t start = std::clock();
    const RelocationResult result = matcher_->localize(observeScene({scan}));
    times_ms.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    for (const Candidate& candidate : result.candidates)
    {
      if (isRight(errorBetween(candidate.pose.mean, truth)))
      {
        place.probability += candidate.probability / place.scans;
      }
      else if (candidate.score > result.candidates.front().score - kAlike)
      {
        confusions.push_back({truth, candidate.pose.mean, candidate.probability});
      }
    }
    const bool first_right = !result.candidates.empty() &&
                             isRight(errorBetween(result.candidates.front().pose.mean, truth));
    const bool localized = result.verdict == Verdict::localized;
    place.right += first_right ? 1 : 0;
    place.localized += localized ? 1 : 0;
    place.fooled += localized && !first_right ? 1 : 0;
  }

  MotionIncrement odometry(const TPose2D& motion)
  {
    const double along = kAlongError * std::hypot(motion.x, motion.y) + 1e-3;
    MotionIncrement increment;
    increment.mean = {motion.x + along * noise_.spread(), motion.y + along * noise_.spread(),
                      motion.phi + kTurnError * noise_.spread()};
    increment.covariance.setZero();
    increment.covariance(0, 0) = increment.covariance(1, 1) = along * along;
    increment.covariance(2, 2) = kTurnError * kTurnError;
    return increment;
  }

  std::shared_ptr<const SignatureMatcher> matcher_;
  ScanSimulator simulator_;
  Noise noise_;
};

/// `count` evenly chosen places at which one scan is not enough.
std::vector<CheckedPlace*> unsurePlaces(std::vector<CheckedPlace>& places, std::size_t count)
{
  std::vector<CheckedPlace*> unsure;
  for (CheckedPlace& place : places)
  {
    if (!place.oneScanIsEnough()) unsure.push_back(&place);
  }
  std::vector<CheckedPlace*> chosen;
  const std::size_t wanted = std::min(count, unsure.size());
  for (std::size_t k = 0; k < wanted; ++k) chosen.push_back(unsure[k * unsure.size() / wanted]);
  return chosen;
}

double shareOf(const MapCheck& check, std::uint32_t CheckedPlace::*count)
{
  double sum = 0;
  double scans = 0;
  for (const CheckedPlace& place : check.places)
  {
    sum += place.*count;
    scans += place.scans;
  }
  return scans > 0 ? sum / scans : 0;
}
}  // namespace

double MapCheck::recall() const
{
  return shareOf(*this, &CheckedPlace::right);
}

double MapCheck::localizedShare() const
{
  return shareOf(*this, &CheckedPlace::localized);
}

double MapCheck::fooledShare() const
{
  return shareOf(*this, &CheckedPlace::fooled);
}

double MapCheck::enoughShare() const
{
  const auto enough = std::count_if(places.begin(), places.end(),
                                    [](const CheckedPlace& p) { return p.oneScanIsEnough(); });
  return static_cast<double>(enough) / static_cast<double>(places.size());
}

std::vector<double> MapCheck::drives() const
{
  std::vector<double> lengths;
  for (const CheckedPlace& place : places)
  {
    if (place.drive) lengths.push_back(*place.drive);
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

MapCheck checkMap(const std::shared_ptr<const FeatureMap>& map, const SimulatedLaserOptions& laser,
                  const CheckOptions& options, const std::function<void(double share)>& progress)
{
  if (!map->field()) throw std::invalid_argument("is of landmarks alone; the check needs walls");
  const FreeSpaceGrid space(*map->field());
  std::vector<TPose2D> poses = options.poses;
  if (poses.empty())
  {
    for (const TPoint2D& place : space.spreadPlaces(options.places))
      poses.emplace_back(place.x, place.y, 0);
  }
  constexpr double kShareOfScans = 0.6;  // of the time, about
  MapCheck check;
  check.laser = laser;
  check.area = space.area();
  check.free_area = map->area();
  Checker checker(map, laser, options.seed);
  for (const TPose2D& pose : poses)
  {
    check.places.push_back(checker.ask(pose, options.scans, options.poses.empty()));
    if (progress)
    {
      progress(kShareOfScans * static_cast<double>(check.places.size()) /
               static_cast<double>(poses.size()));
    }
  }
  const auto unsure = unsurePlaces(check.places, options.drives);
  for (std::size_t k = 0; k < unsure.size(); ++k)
  {
    unsure[k]->drive = checker.driveFrom(space, {unsure[k]->pose.x, unsure[k]->pose.y});
    if (progress)
    {
      progress(kShareOfScans + (1 - kShareOfScans) * static_cast<double>(k + 1) /
                                   static_cast<double>(unsure.size()));
    }
  }
  check.twins = gatherTwins(checker.confusions);
  check.times_ms = std::move(checker.times_ms);
  return check;
}
}  // namespace sigloc
