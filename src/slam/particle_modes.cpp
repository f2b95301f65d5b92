// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "slam/particle_modes.h"

#include "geometry/same_place.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <map>
#include <tuple>

namespace sigloc
{
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kBinSize = 0.5;  // [m]
constexpr double kBinAngle = 20.0 * M_PI / 180.0;
constexpr double kModeDistance = 0.75;  // [m]
constexpr double kModeAngle = 20.0 * M_PI / 180.0;
constexpr double kLeastWeight = 1e-4;  // of a mode
constexpr int kMeanShifts = 3;

using Bin = std::tuple<long, long, long>;

struct WeightedPose
{
  TPose2D pose;
  double weight;
  bool taken = false;
};

std::vector<WeightedPose> normalised(const mrpt::poses::CPosePDFParticles& particles)
{
  std::vector<WeightedPose> poses;
  poses.reserve(particles.m_particles.size());
  double largest = -1e300;
  for (const auto& particle : particles.m_particles) largest = std::max(largest, particle.log_w);
  double sum = 0;
  for (const auto& particle : particles.m_particles)
  {
    poses.push_back({particle.d, std::exp(particle.log_w - largest)});
    sum += poses.back().weight;
  }
  for (WeightedPose& pose : poses) pose.weight /= sum;
  return poses;
}

Bin binOf(const TPose2D& pose)
{
  return {std::lround(pose.x / kBinSize), std::lround(pose.y / kBinSize),
          std::lround(wrapToPi(pose.phi) / kBinAngle)};
}

/// A particle in the heaviest bin of those that no mode has taken, or null.
WeightedPose* densest(std::vector<WeightedPose>& poses)
{
  std::map<Bin, std::pair<double, WeightedPose*>> bins;
  WeightedPose* best = nullptr;
  double best_weight = kLeastWeight;
  for (WeightedPose& pose : poses)
  {
    if (pose.taken) continue;
    auto& [weight, member] = bins[binOf(pose.pose)];
    weight += pose.weight;
    if (member == nullptr) member = &pose;
    if (weight <= best_weight) continue;
    best_weight = weight;
    best = member;
  }
  return best;
}

/// Mean, covariance and weight of the free particles around a pose.
ParticleMode momentsAround(const std::vector<WeightedPose>& poses, const TPose2D& center)
{
  ParticleMode mode;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const WeightedPose& p : poses)
  {
    if (p.taken || !sameMode(p.pose, center)) continue;
    const Eigen::Vector3d apart(p.pose.x - center.x, p.pose.y - center.y,
                                wrapToPi(p.pose.phi - center.phi));
    mode.weight += p.weight;
    sum += p.weight * apart;
    squares += p.weight * apart * apart.transpose();
  }
  mode.pose.mean = center;
  if (!(mode.weight > 0)) return mode;
  const Eigen::Vector3d mean = sum / mode.weight;
  const Eigen::Matrix3d covariance = squares / mode.weight - mean * mean.transpose();
  mode.pose.mean = {center.x + mean[0], center.y + mean[1], wrapToPi(center.phi + mean[2])};
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c) mode.pose.covariance(r, c) = covariance(r, c);
  }
  return mode;
}
}  // namespace

bool sameMode(const TPose2D& a, const TPose2D& b)
{
  return withinReach(a, b, kModeDistance, kModeAngle);
}

std::vector<ParticleMode> modesOf(const mrpt::poses::CPosePDFParticles& particles,
                                  std::size_t max_modes)
{
  std::vector<WeightedPose> poses = normalised(particles);
  std::vector<ParticleMode> modes;
  while (modes.size() < max_modes)
  {
    WeightedPose* const start = densest(poses);
    if (start == nullptr) break;
    TPose2D center = start->pose;
    ParticleMode mode;
    for (int i = 0; i < kMeanShifts; ++i)
    {
      mode = momentsAround(poses, center);
      if (i + 1 < kMeanShifts) center = mode.pose.mean;
    }
    start->taken = true;  // also where the means have shifted away from it: so this ends
    for (WeightedPose& p : poses)
    {
      if (sameMode(p.pose, center)) p.taken = true;
    }
    if (mode.weight > kLeastWeight) modes.push_back(mode);
  }
  std::stable_sort(modes.begin(), modes.end(),
                   [](const ParticleMode& a, const ParticleMode& b)
                   { return a.weight > b.weight; });
  return modes;
}
}  // namespace sigloc
