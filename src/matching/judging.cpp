// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/matching/judging.h"

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
}  // namespace sigloc
