// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/robot_simulation.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kLookAhead = 0.6;  // [m]

/// Micrometres and microradians: real encoders are coarser by far, and logs stay the same where
/// another processor's sine differs in its last bit.
TPose2D rounded(const TPose2D& pose)
{
  constexpr double kSteps = 1e6;
  return {std::round(pose.x * kSteps) / kSteps, std::round(pose.y * kSteps) / kSteps,
          std::round(pose.phi * kSteps) / kSteps};
}

/// A path that grows: new way-points are planned when the look-ahead point passes its end.
class EndlessPath
{
 public:
  EndlessPath(const FreeSpace& space, std::uint64_t seed) : space_(space), random_(seed, 10)
  {
    points_.push_back(space_.randomPlace(random_));
    lengths_.push_back(0);
  }

  /// Returns the position at a distance [m] along the path; distances must not shrink by more than
  /// the look-ahead between calls.
  TPoint2D at(double distance)
  {
    while (lengths_.back() <= distance) extend();
    const auto after = std::upper_bound(lengths_.begin(), lengths_.end(), distance);
    const auto i = static_cast<std::size_t>(after - lengths_.begin());
    const double share = (distance - lengths_[i - 1]) / (lengths_[i] - lengths_[i - 1]);
    return points_[i - 1] + (points_[i] - points_[i - 1]) * share;
  }

 private:
  void extend()
  {
    const TPoint2D from = points_.back();
    for (const TPoint2D& p : space_.path(from, space_.randomPlace(random_)))
    {
      const TPoint2D d = p - points_.back();
      const double length = std::hypot(d.x, d.y);
      if (length < 1e-6) continue;
      points_.push_back(p);
      lengths_.push_back(lengths_.back() + length);
    }
  }

  const FreeSpace& space_;
  Random random_;
  std::vector<TPoint2D> points_;
  std::vector<double> lengths_;  ///< [m] from the start to each point
};
}  // namespace

std::vector<TPose2D> simulateTruth(const FreeSpace& space, const DriveOptions& options,
                                   std::uint64_t seed)
{
  checkOptions(options);
  EndlessPath path(space, seed);
  const double max_turn = options.turn_rate_deg * M_PI / 180.0 * options.step_time;
  const double stride = options.speed * options.step_time;
  const auto heading_at = [&](double distance, double fallback)
  {
    const TPoint2D d = path.at(distance + kLookAhead) - path.at(distance);
    // Where the path turns back on itself, the point ahead may be the robot's own position.
    return std::hypot(d.x, d.y) > 0.05 ? std::atan2(d.y, d.x) : fallback;
  };
  double driven = 0;
  double phi = heading_at(0, 0);
  std::vector<TPose2D> poses;
  while (poses.size() < options.max_steps)
  {
    const TPoint2D place = path.at(driven);
    poses.emplace_back(place.x, place.y, mrpt::math::wrapToPi(phi));
    if (driven >= options.metres) break;
    const double next = std::min(driven + stride, options.metres);
    const double turn = mrpt::math::wrapToPi(heading_at(next, phi) - phi);
    if (std::abs(turn) <= max_turn)
    {
      driven = next;
      phi += turn;
    }
    else
    {
      phi += std::copysign(max_turn, turn);
    }
  }
  return poses;
}

std::vector<MotionIncrement> simulateOdometry(const std::vector<TPose2D>& truth,
                                              const OdometryOptions& options, std::uint64_t seed)
{
  checkOptions(options);
  Random random(seed, 11);
  std::vector<MotionIncrement> motions(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const TPose2D exact = i > 0 ? truth[i] - truth[i - 1] : TPose2D{};
    motions[i].covariance = odometryCovariance(exact, options);
    if (i == 0) continue;
    const Eigen::Matrix3d covariance = motions[i].covariance.asEigen();
    const Eigen::Matrix3d root = covariance.llt().matrixL();
    Eigen::Vector3d noise;
    for (int k = 0; k < 3; ++k) noise[k] = random.normal();
    noise = root * noise;
    motions[i].mean = rounded(
        {exact.x + noise[0], exact.y + noise[1], mrpt::math::wrapToPi(exact.phi + noise[2])});
  }
  return motions;
}

namespace
{
/// Everything of a drive but the observations.
std::vector<DriveStep> simulateMotion(const World& world, const DriveOptions& drive,
                                      const OdometryOptions& odometry, std::uint64_t seed)
{
  checkOptions(drive);
  const FreeSpace space(world, drive.clearance);
  const std::vector<TPose2D> truth = simulateTruth(space, drive, seed);
  const std::vector<MotionIncrement> motions = simulateOdometry(truth, odometry, seed);
  std::vector<DriveStep> steps(truth.size());
  TPose2D summed;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    summed = summed + motions[i].mean;
    steps[i].time = kSimulationEpoch + drive.step_time * static_cast<double>(i);
    steps[i].world_from_robot = truth[i];
    steps[i].odometry = rounded(summed);
    steps[i].motion = motions[i];
  }
  return steps;
}
}  // namespace

std::vector<DriveStep> simulateDrive(const World& world, const DriveOptions& drive,
                                     const OdometryOptions& odometry, const LaserOptions& laser,
                                     std::uint64_t seed)
{
  std::vector<DriveStep> steps = simulateMotion(world, drive, odometry, seed);
  const LaserSimulator simulator(world, laser);
  Random random(seed, 12);
  for (DriveStep& step : steps) step.scan = simulator.scan(step.world_from_robot, random);
  return steps;
}

std::vector<DriveStep> simulateLandmarkDrive(const World& world, const DriveOptions& drive,
                                             const OdometryOptions& odometry,
                                             const LandmarkSensorOptions& sensor,
                                             std::uint64_t seed)
{
  std::vector<DriveStep> steps = simulateMotion(world, drive, odometry, seed);
  const LandmarkSimulator simulator(world, sensor);
  Random random(seed, 14);
  for (DriveStep& step : steps)
  {
    step.landmarks = simulator.observe(step.world_from_robot, random).features;
  }
  return steps;
}

std::vector<PosedScans> simulateMapping(const World& world, double spacing, double clearance,
                                        const LaserOptions& laser, std::uint64_t seed)
{
  const FreeSpace space(world, clearance);
  const LaserSimulator simulator(world, laser);
  Random random(seed, 13);
  std::vector<PosedScans> scans;
  for (const TPoint2D& place : space.coverage(spacing))
  {
    TPose2D pose{place.x, place.y, random.uniform(-M_PI, M_PI)};
    scans.push_back({pose, {simulator.scan(pose, random)}});
    if (laser.fov_deg >= 300) continue;
    pose.phi = mrpt::math::wrapToPi(pose.phi + M_PI);
    scans.push_back({pose, {simulator.scan(pose, random)}});
  }
  return scans;
}
}  // namespace sigloc
