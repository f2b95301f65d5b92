// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/features/JcbbRelocation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "matching/features/SplitMix.h"
#include "matching/generation/sampling.h"
#include "signature/location_constraint.h"

namespace sigloc
{
namespace
{
constexpr std::uint32_t kSampleSize = 4;  // p
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

/// The features still to be paired after a base, and the pairings of the branch being followed.
/// With a known map the joint distance is the running sum of the normalised innovations.
struct JcbbRelocation::Completion
{
  struct Open
  {
    std::uint32_t observed;
    std::vector<std::uint32_t> mapped;
  };
  std::vector<Open> open;
  PoseEstimate pose;
  double distance = 0;
  int degrees = 0;
  std::vector<FeaturePairing> pairings;
  std::vector<FeaturePairing> best;
  double best_distance = std::numeric_limits<double>::infinity();
};

JcbbRelocation::JcbbRelocation(const FeatureMap& map, const GeneratorOptions& options,
                               const JcbbOptions& jcbb, std::uint64_t budget)
    : FeatureOpponent(map, options, budget), jcbb_(jcbb)
{
}

std::uint32_t JcbbRelocation::baseSize() const
{
  return kSampleSize;
}

std::vector<std::uint32_t> JcbbRelocation::compatible(Query& query, const Completion& completion,
                                                      const FeaturePairing& anchor,
                                                      std::uint32_t observed) const
{
  const PreparedScene& scene = query.scene;
  std::vector<std::uint32_t> near;
  gather(query, anchor, observed, near);
  std::vector<std::pair<double, std::uint32_t>> ranked;
  for (const std::uint32_t l : near)
  {
    if (holds(completion.pairings, {observed, l}, isSegment(scene.views[observed].type())))
      continue;
    ++query.counters.checks;
    const PlanarMeasurement m = placeMeasurement(completion.pose, scene.views[observed],
                                                 map().view(l), scene.relative_sigma);
    const double distance =
        squaredInnovation(m, innovationCovariance(completion.pose.covariance, m));
    if (distance <= gates().planar) ranked.emplace_back(distance, l);
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::uint32_t> mapped;
  mapped.reserve(ranked.size());
  for (const auto& [distance, l] : ranked) mapped.push_back(l);
  return mapped;
}

void JcbbRelocation::branch(Query& query, Completion& completion, std::size_t level) const
{
  if (query.exhausted()) return;
  const std::size_t most = completion.pairings.size() + completion.open.size() - level;
  const bool promises =
      most > completion.best.size() ||
      (most == completion.best.size() && completion.distance < completion.best_distance);
  if (!promises) return;
  if (level == completion.open.size())
  {
    completion.best = completion.pairings;
    completion.best_distance = completion.distance;
    return;
  }
  constexpr int kPlanar = 2;
  const PreparedScene& scene = query.scene;
  const std::uint32_t q = completion.open[level].observed;
  const DirectedFeature& observed = scene.views[q];
  const PoseEstimate pose = completion.pose;
  const double before = completion.distance;
  bool paired = false;
  for (const std::uint32_t l : completion.open[level].mapped)
  {
    if (holds(completion.pairings, {q, l}, isSegment(observed.type()))) continue;
    ++query.counters.checks;
    const PlanarMeasurement m =
        placeMeasurement(pose, observed, map().view(l), scene.relative_sigma);
    const double distance = squaredInnovation(m, innovationCovariance(pose.covariance, m));
    if (!jointlyCompatible(before + distance, completion.degrees + kPlanar)) continue;
    update(completion.pose, m);
    completion.distance = before + distance;
    completion.degrees += kPlanar;
    completion.pairings.push_back({q, l});
    branch(query, completion, level + 1);
    completion.pairings.pop_back();
    completion.degrees -= kPlanar;
    completion.distance = before;
    completion.pose = pose;
    paired = true;
    if (jcbb_.greedy) break;
  }
  // The star branch: the feature is spurious.
  if (!paired || !jcbb_.greedy) branch(query, completion, level + 1);
}

void JcbbRelocation::complete(Query& query, const Draw& draw) const
{
  ++query.counters.hypotheses;
  const auto base = fit(query, draw.pairings);
  if (!base || !jointlyCompatible(base->distance, base->degrees)) return;

  Completion completion;
  completion.pose = base->pose;
  completion.distance = base->distance;
  completion.degrees = base->degrees;
  completion.pairings = completion.best = draw.pairings;
  const PreparedScene& scene = query.scene;
  const std::uint32_t* order = scene.orderFrom(draw.observed.front());
  for (std::size_t step = 0; step < scene.size(); ++step)
  {
    const std::uint32_t q = order[step];
    const bool drawn = std::any_of(draw.pairings.begin(), draw.pairings.end(),
                                   [&](const FeaturePairing& p) { return p.observed == q; });
    if (drawn) continue;
    auto mapped = compatible(query, completion, draw.pairings.front(), q);
    if (!mapped.empty()) completion.open.push_back({q, std::move(mapped)});
  }
  branch(query, completion, 0);
  const auto whole = fit(query, completion.best);
  if (whole && jointlyCompatible(whole->distance, whole->degrees))
  {
    add(query, completion.best, *whole);
  }
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
  double good = jcbb_.good_share;
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
