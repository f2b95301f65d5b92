// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/poses/CPosePDFParticles.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>
#include <numeric>
#include <stdexcept>

#include "eval/methods/particles/lost_filter.h"
#include "eval/methods/RelocationMethod.h"
#include "eval/worlds/simulation_files.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;
using mrpt::poses::CPosePDFParticles;

constexpr std::size_t kMaxRanked = 10;

/// A hash of the scans (FNV-1a over their ranges), so that each is matched with other particles.
std::uint32_t fingerprint(const std::vector<LaserScan>& scans)
{
  std::uint32_t hash = 2166136261U;
  for (const LaserScan& scan : scans)
  {
    for (const float range : scan.ranges)
    {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &range, sizeof(bits));
      for (int byte = 0; byte < 4; ++byte) hash = (hash ^ (bits >> (8 * byte) & 0xFFU)) * 16777619U;
    }
  }
  return hash;
}

/// Particles that would all be right answers if one of them were the truth.
bool belongTogether(const TPose2D& a, const TPose2D& b)
{
  return isRight(errorBetween(a, b));
}

/// Clusters of particles around the heaviest that no cluster before has, ranked by their weight.
std::vector<Candidate> heaviestClusters(const CPosePDFParticles& cloud)
{
  const auto& particles = cloud.m_particles;
  const double heaviest =
      std::max_element(particles.begin(), particles.end(),
                       [](const auto& a, const auto& b) { return a.log_w < b.log_w; })
          ->log_w;
  const auto weight = [&](const auto& particle) { return std::exp(particle.log_w - heaviest); };
  const double sum =
      std::accumulate(particles.begin(), particles.end(), 0.0,
                      [&](double total, const auto& particle) { return total + weight(particle); });
  std::vector<const CPosePDFParticles::CParticleData*> rest;
  rest.reserve(particles.size());
  for (const auto& particle : particles) rest.push_back(&particle);
  std::vector<Candidate> clusters;
  while (!rest.empty() && clusters.size() < kMaxRanked)
  {
    const TPose2D centre =
        (*std::max_element(rest.begin(), rest.end(),
                           [](const auto* a, const auto* b) { return a->log_w < b->log_w; }))
            ->d;
    const auto members = std::stable_partition(
        rest.begin(), rest.end(), [&](const auto* p) { return !belongTogether(p->d, centre); });
    CPosePDFParticles cluster;
    cluster.clearParticles();
    Candidate candidate;
    for (auto member = members; member != rest.end(); ++member)
    {
      cluster.m_particles.push_back(**member);
      candidate.probability += weight(**member) / sum;
    }
    const auto [covariance, mean] = cluster.getCovarianceAndMean();
    candidate.pose = {mean.asTPose(), covariance};
    candidate.score = candidate.probability;
    clusters.push_back(std::move(candidate));
    rest.erase(members, rest.end());
  }
  std::stable_sort(clusters.begin(), clusters.end(),
                   [](const Candidate& a, const Candidate& b)
                   { return a.probability > b.probability; });
  return clusters;
}

class MonteCarloRelocation : public RelocationMethod
{
 public:
  MonteCarloRelocation(const EvaluationMap& map, const MonteCarloSettings& settings,
                       std::uint32_t seed)
      : map_(localizationMapOf(map, toIni(settings))), settings_(settings), seed_(seed)
  {
  }

  RelocationResult localize(const std::vector<LaserScan>& scans) const override
  {
    mrpt::obs::CSensoryFrame frame;
    for (const LaserScan& scan : scans) frame.insert(toRangeScan(scan, 0));
    const std::lock_guard<std::mutex> lock(mutex_);
    detail::LostFilter filter(map_, settings_, seed_ * 1000003U + fingerprint(scans));
    filter.update(nullptr, frame);
    RelocationResult result;
    result.candidates = heaviestClusters(filter.particles());
    result.verdict = Verdict::ambiguous;
    result.counters.poses_scored = filter.particles().m_particles.size();
    return result;
  }

 private:
  mrpt::maps::CMultiMetricMap::Ptr map_;
  MonteCarloSettings settings_;
  std::uint32_t seed_;
  mutable std::mutex mutex_;
};
}  // namespace

std::unique_ptr<RelocationMethod> detail::makeMonteCarloRelocation(
    const std::string& name, const EvaluationMap& map, const RelocationMethodOptions& options)
{
  if (!map.features->field()) throw std::invalid_argument(name + " needs a map with a grid");
  return std::make_unique<MonteCarloRelocation>(
      map, monteCarloSettings(name, freeAreaOf(map), options), options.seed);
}
}  // namespace sigloc
