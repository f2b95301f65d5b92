// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/bayes/CParticleFilter.h>

#include <cstdint>
#include <memory>
#include <optional>

#include "sigloc/bridge/RawlogReader.h"
#include "sigloc/bridge/SignatureMap.h"
#include "sigloc/bridge/SignatureMonteCarlo2D.h"
#include "sigloc/config/option_fields.h"

namespace sigloc
{
/// Section [sigloc.particles]: MRPT's filter where `tracker = particles`.
struct ParticleOptions
{
  static constexpr std::uint32_t kMostParticles = 10000000;

  std::uint32_t particles = 500;
  double motion_sigma = 0.05;
  double motion_turn_sigma = 0.05;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = ParticleOptions;
    visit(OptionField{"particles", &O::particles, 1U, kMostParticles,
                      "[-] how many are drawn when the robot is lost"});
    visit(OptionField{"motion_sigma", &O::motion_sigma, 0.0, 1.0,
                      "[m] standard deviation that a metre of travel adds to the odometry's own"});
    visit(
        OptionField{"motion_turn_sigma", &O::motion_turn_sigma, 0.0, 1.0,
                    "[rad] standard deviation that a metre of travel adds to the odometry's own"});
  }
};

/// Follows the robot of a log with SignatureMonteCarlo2D: HypothesisTracker's counterpart for those
/// who prefer particles.
///
/// Seeds MRPT's random generator of the calling thread when made, and draws from it: results are a
/// function of the seed as long as nothing else draws between the steps.
class ParticleTracker
{
 public:
  /// Throws std::invalid_argument for a null map or matcher, or options outside their ranges.
  ParticleTracker(std::shared_ptr<const SignatureMap> map,
                  std::shared_ptr<const SignatureMatcher> matcher,
                  const TrackerOptions& tracking = {}, const ParticleOptions& options = {},
                  std::uint32_t seed = 1, const FeatureExtractorOptions& extraction = {});

  /// Advances by one step and returns the belief after it. Without a motion a wide prior is used.
  const Belief& step(const RawlogStep& step);

  /// Forgets everything: lost anywhere, or inside a region.
  void reset(const std::optional<PoseRegion>& region = std::nullopt) { filter_.forget(region); }

  /// True when the last step ran a relocation.
  bool relocated() const { return filter_.relocated(); }
  /// The particles themselves.
  const SignatureMonteCarlo2D& filter() const { return filter_; }

 private:
  TrackerOptions tracking_;
  ParticleOptions options_;
  SignatureMonteCarlo2D filter_;
  mrpt::bayes::CParticleFilter executor_;
};
}  // namespace sigloc
