// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/bayes/CParticleFilter.h>

#include <optional>

#include "localize/particle_library.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/slam/SignatureMonteCarlo2D.h"
#include "tracking/tracks/travel.h"

namespace sigloc
{
/// Tracks the robot of a log with SignatureMonteCarlo2D: the counterpart of HypothesisTracker that
/// uses particles.
///
/// The constructor seeds MRPT's random generator of the calling thread, and each step draws from
/// it. The results depend on the seed alone as long as nothing else draws between the steps.
class ParticleTracker : public LogTracker
{
 public:
  /// Throws std::invalid_argument for a null map or matcher, or options outside their ranges.
  explicit ParticleTracker(const ParticleTrackerParts& parts);

  /// Advances by one step and returns the belief after it. Without a motion a wide prior is used.
  const Belief& step(const RawlogStep& step) override;

  /// Starts anew: the robot is lost anywhere, or inside a region.
  void reset(const std::optional<PoseRegion>& region = std::nullopt) override
  {
    filter_.forget(region);
  }

  /// True when the last step ran a relocation.
  bool relocated() const override { return filter_.relocated(); }
  /// The particles themselves.
  const SignatureMonteCarlo2D& filter() const { return filter_; }

 private:
  TrackerOptions tracking_;
  ParticleOptions options_;
  mrpt::math::TPose2D ground_;  // the robot's pose by odometry alone
  TravelMeter meter_;  // of it
  SignatureMonteCarlo2D filter_;
  mrpt::bayes::CParticleFilter executor_;
};
}  // namespace sigloc

/// What loadParticleTracker() finds by this name; its caller owns the tracker.
extern "C" sigloc::LogTracker* siglocMakeParticleTracker(const sigloc::ParticleTrackerParts& parts);
