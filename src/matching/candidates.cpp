// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/candidates.h"

#include <bitset>
#include <cmath>

#include "matching/dense/ExplainedConstraints.h"

namespace sigloc
{
std::vector<Candidate> candidatesOf(const std::vector<RankedPose>& ranked,
                                    const DenseVerifier& verifier, const ObservedScene& scene)
{
  std::vector<Candidate> candidates;
  candidates.reserve(ranked.size());
  const ExplainedConstraints constraints(scene.features);
  for (const auto& [pose, evidence] : ranked)
  {
    Candidate candidate;
    candidate.pose.mean = pose;
    candidate.score = evidence.score;
    candidate.explained = 0.5 * (evidence.fine + evidence.coarse);
    candidate.through_wall = evidence.through_wall;
    candidate.in_free = evidence.in_free;
    if (evidence.score >= ranked.front().evidence.score - DenseVerifier::kContender)
    {
      candidate.constraints = constraints.countAt(pose, verifier.field());
    }
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

double angularCoverage(const ObservedScene& scene)
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
