// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/features/JcbbRelocation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "matching/features/sampling.h"
#include "matching/features/SplitMix.h"
#include "signature/location_constraint.h"

namespace sigloc
{
namespace
{
constexpr std::uint32_t kSampleSize = 4;  // p
constexpr double kGoodShare = 0.5;  // P_good, before anything is found
constexpr double kFailure = 0.05;  // P_fail

bool holds(const std::vector<FeaturePairing>& pairings, const FeaturePairing& other, bool wall)
{
  return std::any_of(
      pairings.begin(), pairings.end(),
      [&](const FeaturePairing& pairing)
      { return pairing.observed == other.observed || (pairing.mapped == other.mapped && !wall); });
}
}  // namespace

/// One draw of observed features, with the pairings of its first ones.
struct JcbbRelocation::Draw
{
  std::vector<std::uint32_t> observed;
  std::vector<FeaturePairing> pairings;
  std::array<std::vector<std::uint32_t>, kSampleSize> candidates;
};

std::uint32_t JcbbRelocation::baseSize() const
{
  return kSampleSize;
}

void JcbbRelocation::complete(Query& query, const Draw& draw) const
{
  ++query.counters.hypotheses;
  const auto base = fit(query, draw.pairings);
  if (!base || !jointlyCompatible(base->distance, base->degrees)) return;

  // With a known map the joint distance is the running sum of the normalised innovations.
  const PreparedScene& scene = query.scene;
  PoseEstimate pose = base->pose;
  double joint_distance = base->distance;
  int joint_degrees = base->degrees;
  std::vector<FeaturePairing> pairings = draw.pairings;
  std::vector<std::uint32_t> candidates;
  const std::uint32_t* order = scene.orderFrom(draw.observed.front());
  for (std::size_t step = 0; step < scene.size(); ++step)
  {
    const std::uint32_t q = order[step];
    const DirectedFeature& observed = scene.views[q];
    const bool wall = isSegment(observed.type());
    const bool drawn = std::any_of(draw.pairings.begin(), draw.pairings.end(),
                                   [&](const FeaturePairing& p) { return p.observed == q; });
    if (drawn) continue;
    gather(query, draw.pairings.front(), q, candidates);
    double nearest = std::numeric_limits<double>::infinity();
    std::uint32_t best = 0;
    for (const std::uint32_t l : candidates)
    {
      if (holds(pairings, {q, l}, wall)) continue;
      ++query.counters.checks;
      const PlanarMeasurement m =
          placeMeasurement(pose, observed, map().view(l), scene.relative_sigma);
      const double distance = squaredInnovation(m, innovationCovariance(pose.covariance, m));
      if (distance > gates().planar || distance >= nearest) continue;
      nearest = distance;
      best = l;
    }
    if (!std::isfinite(nearest)) continue;
    constexpr int kPlanar = 2;
    if (!jointlyCompatible(joint_distance + nearest, joint_degrees + kPlanar)) continue;
    joint_distance += nearest;
    joint_degrees += kPlanar;
    update(pose, placeMeasurement(pose, observed, map().view(best), scene.relative_sigma));
    pairings.push_back({q, best});
  }
  const auto whole = fit(query, pairings);
  if (whole && jointlyCompatible(whole->distance, whole->degrees)) add(query, pairings, *whole);
}

void JcbbRelocation::extend(Query& query, Draw& draw, std::size_t level) const
{
  if (query.exhausted()) return;
  if (level == draw.observed.size()) return complete(query, draw);
  for (const std::uint32_t l : draw.candidates[level])
  {
    const FeaturePairing next{draw.observed[level], l};
    // The first pairing has chosen the candidates.
    const bool fits = std::all_of(draw.pairings.begin() + 1, draw.pairings.end(),
                                  [&](const FeaturePairing& p) { return binary(query, p, next); });
    if (!fits) continue;
    draw.pairings.push_back(next);
    extend(query, draw, level + 1);
    draw.pairings.pop_back();
  }
}

void JcbbRelocation::search(Query& query) const
{
  const auto n = static_cast<std::uint32_t>(query.scene.size());
  const std::uint32_t size = std::min(kSampleSize, n);
  SplitMix random(options().seed);
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0U);
  double good = kGoodShare;
  std::uint32_t draws = drawsNeeded(kFailure, std::pow(good, size));
  Draw draw;
  for (std::uint32_t d = 0; d < draws; ++d)
  {
    random.shuffle(order);
    draw.observed.assign(order.begin(), order.begin() + size);
    for (std::uint32_t k = 0; k < map().size() && !query.exhausted(); ++k)
    {
      if (!unary(query, draw.observed[0], k)) continue;
      draw.pairings.assign(1, {draw.observed[0], k});
      bool complete = true;
      for (std::size_t level = 1; level < size && complete; ++level)
      {
        gather(query, draw.pairings[0], draw.observed[level], draw.candidates[level]);
        complete = !draw.candidates[level].empty();
      }
      if (complete) extend(query, draw, 1);
    }
    // The best pairings so far estimate how many of the features are good.
    good = std::max(good, static_cast<double>(query.found.bestSupport()) / n);
    draws = std::min(draws, drawsNeeded(kFailure, std::pow(good, size)));
  }
}
}  // namespace sigloc
