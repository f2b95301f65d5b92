// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "eval/data/evaluation_data.h"
#include "eval/methods/RelocationMethod.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/tracking/HypothesisTracker.h"

namespace sigloc
{
/// What a method claims after a step. Plain data: worker processes send it as bytes.
struct TrackingClaim
{
  static constexpr std::size_t kWeights = 4;

  bool confident = false;
  bool has_pose = false;
  mrpt::math::TPose2D pose;  ///< map_from_robot, where has_pose
  bool belief = false;  ///< the method returns weighted Gaussians: the fields below are filled
  Verdict verdict = Verdict::too_little_seen;
  std::uint32_t hypotheses = 0;  ///< alive
  std::array<double, kWeights> weights{};  ///< of the heaviest hypotheses, heaviest first
  std::array<mrpt::math::TPose2D, kWeights> poses{};  ///< of the same hypotheses
  InMapEvidence evidence;  ///< of the heaviest one
  double elsewhere = 1;  ///< weight of "somewhere else".
  /// How well the pose explains the scan, in [0, 1]: Belief::reliability. Of `mcl-best` it is
  /// MRPT's measure, while the cloud is tight. Else NaN.
  double reliability = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 9> covariance{};  ///< of `pose`, row by row
};

/// The claimed pose with its covariance, zero where the claim has none.
GaussianPose poseOf(const TrackingClaim& claim);

/// Returns the squared Mahalanobis distance of a claimed pose, heading wrapped, from the truth
/// (3 degrees of freedom); NaN where the claim has no covariance.
double squaredNormalisedError(const TrackingClaim& claim, const mrpt::math::TPose2D& truth);

/// A claim and its cost on one thread.
struct TimedClaim
{
  TrackingClaim claim;
  double time_ms = 0;
};

/// A method that finds and tracks a robot, lost at first. Each run has its own object.
class TrackingMethod
{
 public:
  virtual ~TrackingMethod() = default;
  /// Returns a claim for every step of a drive. Called once.
  virtual std::vector<TimedClaim> drive(const std::vector<RawlogStep>& steps) = 0;
};

/// A method that processes a drive step by step.
class SteppedTracking : public TrackingMethod
{
 public:
  virtual TrackingClaim step(const RawlogStep& step) = 0;
  /// Times are CPU times.
  std::vector<TimedClaim> drive(const std::vector<RawlogStep>& steps) final;
};

/// The common part of all runs of a method: built once from the map, then used for one run after
/// another.
class TrackingMethodFactory
{
 public:
  virtual ~TrackingMethodFactory() = default;
  /// Returns a run that is lost anywhere in the map. The seed determines it.
  virtual std::unique_ptr<TrackingMethod> start(std::uint32_t seed) const = 0;
  /// True when runs use a random generator that the process shares, so that each run needs its own
  /// process.
  virtual bool needsOwnProcess() const { return false; }
};

/// Names that `makeTrackingMethod` accepts: `signature`, `signature-mcl` (MRPT's filter, started
/// and recovered by signatures), `mcl` in four settings, and `mcl-stock`, the pf-localization
/// program.
std::vector<std::string> trackingMethodNames();

/// Throws std::invalid_argument for a name that `makeTrackingMethod` does not accept.
void checkTrackingMethods(const std::vector<std::string>& names);

/// Throws std::invalid_argument for an unknown name or a map without what the method needs.
std::unique_ptr<TrackingMethodFactory> makeTrackingMethod(const std::string& name,
                                                          const EvaluationMap& map,
                                                          const RelocationMethodOptions& options);

namespace detail
{
/// MRPT's filter: `mcl` with the options that pf-localization ships, `mcl-fixed` with 40 000
/// particles throughout, `mcl-tuned` with as many particles as the map's free area needs, up to 200
/// 000. `mcl-best` is `mcl-tuned` with all beams, their likelihood tempered, and claims only where
/// MRPT's measure of reliability is high enough.
std::unique_ptr<TrackingMethodFactory> makeMonteCarlo(const std::string& name,
                                                      const EvaluationMap& map,
                                                      const RelocationMethodOptions& options);

/// The stock program pf-localization with the options of `mcl`, one process for each run. It seeds
/// itself, so its claims differ from run to run. Its times are those that it prints, by the wall
/// clock.
std::unique_ptr<TrackingMethodFactory> makeStockMonteCarlo(const EvaluationMap& map,
                                                           const RelocationMethodOptions& options);
}  // namespace detail
}  // namespace sigloc
