// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "eval/data/method_names.h"
#include "eval/methods/TrackingMethod.h"
#include "eval/process/cpu_time.h"
#include "sigloc/tracking/HypothesisTracker.h"
#include "slam/ParticleTracker.h"

namespace sigloc
{
namespace
{
TrackingClaim claimOf(const Belief& belief)
{
  TrackingClaim claim;
  claim.confident = belief.verdict == Verdict::localized;
  claim.belief = true;
  claim.verdict = belief.verdict;
  claim.hypotheses = static_cast<std::uint32_t>(belief.hypotheses.size());
  claim.elsewhere = belief.elsewhere;
  claim.reliability = belief.reliability;
  for (std::size_t i = 0; i < std::min(belief.hypotheses.size(), TrackingClaim::kWeights); ++i)
  {
    claim.weights[i] = belief.hypotheses[i].weight;
    claim.poses[i] = belief.hypotheses[i].pose.mean;
  }
  claim.has_pose = !belief.hypotheses.empty();
  if (!claim.has_pose) return claim;
  const GaussianPose& first = belief.hypotheses.front().pose;
  claim.pose = first.mean;
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c)
    {
      claim.covariance[static_cast<std::size_t>(3 * r + c)] = first.covariance(r, c);
    }
  }
  return claim;
}

class SignatureTracking : public SteppedTracking
{
 public:
  SignatureTracking(std::shared_ptr<const SignatureMatcher> matcher,
                    const std::optional<PoseRegion>& region)
      : tracker_(std::move(matcher))
  {
    tracker_.reset(region);
  }

  TrackingClaim step(const RawlogStep& step) override
  {
    TrackingClaim claim = claimOf(tracker_.step(step.motion, observe(step)));
    claim.evidence = tracker_.evidence();
    return claim;
  }

 private:
  HypothesisTracker tracker_;
};

/// MRPT's particle filter with a few hundred particles, started and recovered by signatures.
class ParticleTracking : public SteppedTracking
{
 public:
  ParticleTracking(std::shared_ptr<const SignatureMap> map,
                   std::shared_ptr<const SignatureMatcher> matcher,
                   const std::optional<PoseRegion>& region, const ParticleOptions& particles,
                   std::uint32_t seed)
      : tracker_({std::move(map), std::move(matcher), {}, particles, seed, {}})
  {
    tracker_.reset(region);
  }

  TrackingClaim step(const RawlogStep& step) override { return claimOf(tracker_.step(step)); }

 private:
  ParticleTracker tracker_;
};

class SignatureTrackingFactory : public TrackingMethodFactory
{
 public:
  SignatureTrackingFactory(const EvaluationMap& map, const RelocationMethodOptions& options,
                           bool particles)
      : region_(options.region)
  {
    if (particles) particle_map_ = std::make_shared<const SignatureMap>(FeatureMap(*map.features));
    if (options.particles) particles_.particles = *options.particles;
    MatcherOptions matching;
    matching.seed = options.seed;
    matching.use_dense_field = options.use_dense_field;
    matcher_ = std::make_shared<const SignatureMatcher>(map.features, matching);
  }

  std::unique_ptr<TrackingMethod> start(std::uint32_t seed) const override
  {
    if (particle_map_)
    {
      return std::make_unique<ParticleTracking>(particle_map_, matcher_, region_, particles_, seed);
    }
    return std::make_unique<SignatureTracking>(matcher_, region_);
  }

  // MRPT's random generator is one for all runs.
  bool needsOwnProcess() const override { return particle_map_ != nullptr; }

 private:
  std::shared_ptr<const SignatureMatcher> matcher_;
  std::shared_ptr<const SignatureMap> particle_map_;  // null: our own tracker
  ParticleOptions particles_;
  std::optional<PoseRegion> region_;
};
}  // namespace

std::vector<TimedClaim> SteppedTracking::drive(const std::vector<RawlogStep>& steps)
{
  std::vector<TimedClaim> claims;
  claims.reserve(steps.size());
  for (const RawlogStep& one : steps)
  {
    const double start = threadCpuSeconds();
    TimedClaim timed;
    timed.claim = step(one);
    timed.time_ms = 1e3 * (threadCpuSeconds() - start);
    claims.push_back(timed);
  }
  return claims;
}

std::vector<std::string> trackingMethodNames()
{
  return {"signature", "signature-mcl", "mcl", "mcl-fixed", "mcl-tuned", "mcl-best", "mcl-stock"};
}

void checkTrackingMethods(const std::vector<std::string>& names)
{
  checkMethodNames(names, trackingMethodNames());
}

GaussianPose poseOf(const TrackingClaim& claim)
{
  GaussianPose pose;
  pose.mean = claim.pose;
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c)
    {
      pose.covariance(r, c) = claim.covariance[static_cast<std::size_t>(3 * r + c)];
    }
  }
  return pose;
}

double squaredNormalisedError(const TrackingClaim& claim, const mrpt::math::TPose2D& truth)
{
  if (!claim.belief || !claim.has_pose) return std::numeric_limits<double>::quiet_NaN();
  return squaredMahalanobisDistance(poseOf(claim), {truth, {}});
}

std::unique_ptr<TrackingMethodFactory> makeTrackingMethod(const std::string& name,
                                                          const EvaluationMap& map,
                                                          const RelocationMethodOptions& options)
{
  if (name == "signature" || name == "signature-mcl")
  {
    return std::make_unique<SignatureTrackingFactory>(map, options, name != "signature");
  }
  if (name == "mcl-stock") return detail::makeStockMonteCarlo(map, options);
  if (name.rfind("mcl", 0) == 0) return detail::makeMonteCarlo(name, map, options);
  refuseMethod(name, trackingMethodNames());
}
}  // namespace sigloc
