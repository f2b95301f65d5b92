// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "slam/ParticleTracker.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/random/RandomGenerators.h>

#include <cmath>
#include <stdexcept>

namespace sigloc
{
using mrpt::bayes::CParticleFilter;
using mrpt::obs::CActionRobotMovement2D;

namespace
{
/// Checks the options before anything is allocated.
const ParticleOptions& checked(const ParticleOptions& options)
{
  checkOptions(options);
  return options;
}
}  // namespace

ParticleTracker::ParticleTracker(const ParticleTrackerParts& parts)
    : tracking_(parts.tracking),
      options_(checked(parts.particles)),
      filter_(parts.particles.particles, parts.tracking)
{
  if (!parts.map || !parts.matcher)
  {
    throw std::invalid_argument("ParticleTracker: no map or matcher");
  }
  filter_.options.metricMap = parts.map;
  filter_.useMatcher(parts.matcher);
  filter_.useExtraction(parts.extraction);
  executor_.m_options.PF_algorithm = CParticleFilter::pfStandardProposal;
  executor_.m_options.resamplingMethod = CParticleFilter::prSystematic;
  // Its own randomize() would keep a Gaussian drawn before.
  mrpt::random::getRandomGenerator() = mrpt::random::CRandomGenerator(parts.seed);
}

const Belief& ParticleTracker::step(const RawlogStep& step)
{
  MotionIncrement motion;
  double sigma = tracking_.free_motion_sigma;
  double turn_sigma = tracking_.free_turn_sigma;
  if (step.motion)
  {
    motion = *step.motion;
    ground_ = ground_ + motion.mean;
    // The poses of a robot at rest jitter. Noise for each of them would drive the particles apart.
    const double travel = meter_.moveTo(ground_, tracking_).with_turns;
    sigma = options_.motion_sigma * std::sqrt(travel);
    turn_sigma = options_.motion_turn_sigma * std::sqrt(travel);
  }
  motion.covariance(0, 0) += sigma * sigma;
  motion.covariance(1, 1) += sigma * sigma;
  motion.covariance(2, 2) += turn_sigma * turn_sigma;

  CActionRobotMovement2D movement;
  movement.estimationMethod =
      CActionRobotMovement2D::emScan2DMatching;  // a distribution of its own
  movement.poseChange =
      mrpt::poses::CPosePDFGaussian::Create(mrpt::poses::CPose2D(motion.mean), motion.covariance);
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);
  executor_.executeOn(filter_, &actions, step.frame.get());
  return filter_.belief();
}
}  // namespace sigloc

sigloc::LogTracker* siglocMakeParticleTracker(const sigloc::ParticleTrackerParts& parts)
{
  return std::make_unique<sigloc::ParticleTracker>(parts).release();
}
