// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "sigloc/eval/TrackingMethod.h"
#include "sigloc/features/FeatureExtractor.h"
#include "sigloc/tracking/HypothesisTracker.h"

namespace sigloc
{
namespace
{
class SignatureTracking : public TrackingMethod
{
 public:
  SignatureTracking(std::shared_ptr<const SignatureMatcher> matcher,
                    const std::optional<PoseRegion>& region)
      : tracker_(std::move(matcher))
  {
    tracker_.reset(region);
  }

  TrackClaim step(const RawlogStep& step) override
  {
    const Belief& belief = tracker_.step(step.motion, observeScene(step.scans));
    TrackClaim claim;
    claim.confident = belief.verdict == Verdict::localized;
    claim.has_pose = !belief.hypotheses.empty();
    if (claim.has_pose) claim.pose = belief.hypotheses.front().pose.mean;
    return claim;
  }

 private:
  HypothesisTracker tracker_;
};

class SignatureTrackingFactory : public TrackingMethodFactory
{
 public:
  SignatureTrackingFactory(const EvaluationMap& map, const RelocationMethodOptions& options)
      : region_(options.region)
  {
    MatcherOptions matching;
    matching.seed = options.seed;
    matching.use_dense_field = options.use_dense_field;
    matcher_ = std::make_shared<const SignatureMatcher>(map.features, matching);
  }

  std::unique_ptr<TrackingMethod> start(std::uint32_t /*seed*/) const override
  {
    return std::make_unique<SignatureTracking>(matcher_, region_);
  }

 private:
  std::shared_ptr<const SignatureMatcher> matcher_;
  std::optional<PoseRegion> region_;
};
}  // namespace

std::vector<std::string> trackingMethodNames()
{
  return {"signature", "mcl", "mcl-fixed", "mcl-tuned"};
}

std::unique_ptr<TrackingMethodFactory> makeTrackingMethod(const std::string& name,
                                                          const EvaluationMap& map,
                                                          const RelocationMethodOptions& options)
{
  if (name == "signature") return std::make_unique<SignatureTrackingFactory>(map, options);
  if (name.rfind("mcl", 0) == 0) return detail::makeMonteCarlo(name, map, options);
  throw std::invalid_argument("unknown method '" + name + "'");
}
}  // namespace sigloc
