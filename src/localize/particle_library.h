// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "sigloc/features/observe_scans.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/plugin/SignatureMap.h"
#include "sigloc/tracking/Belief.h"
#include "sigloc/tracking/TrackerOptions.h"

namespace sigloc
{
/// What a run asks of the tracker that uses particles.
class LogTracker
{
 public:
  LogTracker() = default;
  virtual ~LogTracker() = default;
  LogTracker(const LogTracker&) = delete;
  LogTracker& operator=(const LogTracker&) = delete;

  /// Advances by one step and returns the belief after it.
  virtual const Belief& step(const RawlogStep& step) = 0;
  /// Starts anew: the robot is lost anywhere, or inside a region.
  virtual void reset(const std::optional<PoseRegion>& region) = 0;
  /// True when the last step ran a relocation.
  virtual bool relocated() const = 0;
};

/// What a ParticleTracker is made of.
struct ParticleTrackerParts
{
  std::shared_ptr<const SignatureMap> map;
  std::shared_ptr<const SignatureMatcher> matcher;
  TrackerOptions tracking;
  ParticleOptions particles;
  std::uint32_t seed = 1;
  FeatureExtractorOptions extraction;
};

/// Loads libsigloc-slam and returns a ParticleTracker. That library brings MRPT's mrpt-slam, and by
/// it OpenCV's windows and films: who does not track with particles starts without them. Throws
/// std::runtime_error where it can't be loaded, and what the constructor of ParticleTracker throws.
std::unique_ptr<LogTracker> loadParticleTracker(const ParticleTrackerParts& parts);
}  // namespace sigloc
