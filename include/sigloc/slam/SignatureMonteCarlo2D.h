// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "sigloc/features/observe_scans.h"
#include "sigloc/features/ObservedScene.h"
#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/Belief.h"
#include "sigloc/tracking/TrackerOptions.h"

namespace sigloc
{
class ModeTracker;

/// MRPT's particle filter with a start and a recovery of its own. While the robot is lost,
/// particles are drawn around the candidate poses of a relocation instead of all over the map. So a
/// few hundred particles are enough. Motion, weights and resampling are MRPT's. \cite algorithm
/// section 9
///
///     SignatureMonteCarlo2D filter(500);
///     filter.options.metricMap = map;  // a SignatureMap, or a CMultiMetricMap with one in it
///     mrpt::bayes::CParticleFilter executor;
///     while (...) executor.executeOn(filter, &actions, &frame);
///
/// The robot is lost at first. Setting the particles anew also sets where the robot is. Particles
/// gathered within half a metre are believed. Particles that are spread (`resetUniform`,
/// `resetUniformFreeSpace`) mean that the robot is lost within their bounding box. A step throws
/// std::invalid_argument when there is no SignatureMap.
///
/// Draws from MRPT's random generator of the calling thread. Not thread-safe.
class SignatureMonteCarlo2D : public mrpt::slam::CMonteCarloLocalization2D
{
 public:
  /// `particles` are drawn when the robot is lost; throws std::invalid_argument for none, or for
  /// options outside their ranges.
  explicit SignatureMonteCarlo2D(std::size_t particles = 500, const TrackerOptions& tracking = {});

  ~SignatureMonteCarlo2D() override;

  /// Uses a matcher made before instead of making one of the SignatureMap at the first step.
  void useMatcher(std::shared_ptr<const SignatureMatcher> matcher);

  /// Extracts features from scans with these options instead of the defaults. Throws
  /// std::invalid_argument for options outside their ranges.
  void useExtraction(const FeatureExtractorOptions& extraction);

  /// Declares the robot lost, anywhere or within a region.
  void forget(const std::optional<PoseRegion>& region = std::nullopt);

  /// The belief after the last step: the poses where particles have gathered, and the verdict.
  const Belief& belief() const { return belief_; }
  /// True when the last step ran a relocation.
  bool relocated() const { return relocated_; }

  // Overrides that mrpt::bayes::CParticleFilter calls.
  void prediction_and_update_pfStandardProposal(
      const mrpt::obs::CActionCollection* action, const mrpt::obs::CSensoryFrame* observation,
      const mrpt::bayes::CParticleFilter::TParticleFilterOptions& filtering) override;
  void prediction_and_update_pfAuxiliaryPFStandard(
      const mrpt::obs::CActionCollection* action, const mrpt::obs::CSensoryFrame* observation,
      const mrpt::bayes::CParticleFilter::TParticleFilterOptions& filtering) override;
  void prediction_and_update_pfAuxiliaryPFOptimal(
      const mrpt::obs::CActionCollection* action, const mrpt::obs::CSensoryFrame* observation,
      const mrpt::bayes::CParticleFilter::TParticleFilterOptions& filtering) override;

 private:
  using FilterOptions = mrpt::bayes::CParticleFilter::TParticleFilterOptions;
  void step(const mrpt::obs::CActionCollection* action, const mrpt::obs::CSensoryFrame* observation,
            FilterOptions filtering, const std::function<void(const FilterOptions&)>& update);
  const SignatureMatcher& matcher();
  void believe(const std::optional<PoseRegion>& region, bool known);
  void rememberParticles();
  void noticeReset();
  std::optional<MotionIncrement> motionIn(const mrpt::obs::CActionCollection* action) const;
  void drawStarted();
  CParticleList resampled(std::size_t count);

  std::size_t particles_when_lost_;
  TrackerOptions tracking_;
  FeatureExtractorOptions extraction_;
  std::shared_ptr<const SignatureMatcher> matcher_;
  bool own_matcher_ = true;
  bool lost_ = true;
  std::optional<PoseRegion> region_;  // the region that a lost robot is in
  std::unique_ptr<ModeTracker> modes_;
  std::vector<double> known_x_;  // sorted, of the particles after the last step
  bool relocated_ = false;
  Belief belief_;
};
}  // namespace sigloc
