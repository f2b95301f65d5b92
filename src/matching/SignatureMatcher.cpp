// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/matching/SignatureMatcher.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sigloc/matching/BaseProposer.h"
#include "sigloc/matching/DenseVerifier.h"
#include "sigloc/matching/weighing.h"

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
constexpr std::size_t kMaxBeams = 400;  // used of a scene; more are thinned evenly
}  // namespace

bool PoseRegion::contains(const TPose2D& pose) const
{
  return pose.x >= x_min && pose.x <= x_max && pose.y >= y_min && pose.y <= y_max &&
         std::abs(mrpt::math::wrapToPi(pose.phi - heading)) <= heading_tolerance;
}

SignatureMatcher::SignatureMatcher(std::shared_ptr<const FeatureMap> map,
                                   const MatcherOptions& options)
    : map_(std::move(map)), options_(options)
{
  if (!map_) throw std::invalid_argument("SignatureMatcher: no map");
  checkOptions(options);
  if (map_->field() && options.use_dense_field)
  {
    verifier_ = std::make_unique<DenseVerifier>(*map_->field());
    proposer_ = std::make_unique<BaseProposer>(*map_);
  }
}

SignatureMatcher::~SignatureMatcher() = default;

RelocationResult SignatureMatcher::localize(const ObservedScene& scene,
                                            const std::optional<PoseRegion>& region) const
{
  RelocationResult result;
  if (scene.beams.size() < options_.min_beams)
  {
    result.verdict = Verdict::too_little_seen;
    result.probability = 1;
    return result;
  }
  if (verifier_) verifyDensely(scene, region, result);
  weighCandidates(result);
  return result;
}

std::vector<TPose2D> SignatureMatcher::propose(const ObservedScene& scene) const
{
  std::vector<TPose2D> poses;
  if (!proposer_) return poses;
  for (const PoseProposal& p : proposer_->propose(scene.features))
    poses.emplace_back(p.x, p.y, p.phi);
  return poses;
}

void SignatureMatcher::verifyDensely(const ObservedScene& scene,
                                     const std::optional<PoseRegion>& region,
                                     RelocationResult& result) const
{
  std::vector<PoseProposal> proposals = proposer_->propose(scene.features);
  result.counters.hypotheses += proposals.size();
  if (region)
  {
    const auto outside = [&](const PoseProposal& p) {
      return !region->contains({p.x, p.y, p.phi});
    };
    proposals.erase(std::remove_if(proposals.begin(), proposals.end(), outside), proposals.end());
  }
  const DenseScan scan = makeDenseScan(scene, kMaxBeams);
  for (const RankedPose& ranked :
       verifier_->rank(scan, proposals, options_.max_candidates, result.counters.poses_scored))
  {
    Candidate candidate;
    candidate.pose.mean = ranked.pose;
    candidate.pose.covariance =
        verifier_->covarianceAt(scan, ranked.pose, map_->error().common_sigma);
    candidate.score = ranked.evidence.score;
    candidate.explained = ranked.evidence.coarse;
    candidate.through_wall = ranked.evidence.through_wall;
    result.candidates.push_back(candidate);
  }
}
}  // namespace sigloc
