// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/matching/judging.h"

#include <bitset>
#include <cmath>

#include "explained_facts.h"

namespace sigloc
{
std::vector<Candidate> judgedCandidates(const DenseVerifier& verifier, const ObservedScene& scene,
                                        const DenseScan& scan,
                                        const std::vector<PoseProposal>& proposals,
                                        std::size_t max_candidates, std::uint64_t& poses_scored)
{
  std::vector<Candidate> candidates;
  if (proposals.empty()) return candidates;
  for (const RankedPose& ranked : verifier.rank(scan, proposals, max_candidates, poses_scored))
  {
    Candidate candidate;
    candidate.pose.mean = ranked.pose;
    candidate.score = ranked.evidence.score;
    candidate.explained = ranked.evidence.coarse;
    candidate.through_wall = ranked.evidence.through_wall;
    candidate.in_free = ranked.evidence.in_free;
    candidates.push_back(candidate);
  }
  for (Candidate& candidate : candidates)
  {
    if (candidate.score < candidates.front().score - DenseVerifier::kContender) break;
    candidate.facts = explainedFacts(scene.features, verifier.field(), candidate.pose.mean);
  }
  return candidates;
}

double viewOf(const ObservedScene& scene)
{
  constexpr std::size_t kSectors = 24;
  std::bitset<kSectors> seen;
  for (const BeamEnd& beam : scene.beams)
  {
    const auto ray = beam.point - scene.sensor_origins[beam.origin];
    const double turn = std::atan2(ray.y, ray.x) / (2 * M_PI) + 0.5;
    seen.set(static_cast<std::size_t>(turn * kSectors) % kSectors);
  }
  return static_cast<double>(seen.count()) * 2 * M_PI / kSectors;
}
}  // namespace sigloc
