// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/features/PreparedScene.h"

#include <algorithm>
#include <cmath>

namespace sigloc
{
namespace
{
/// Returns the volume of the gate around a predicted feature, in its own measurement space. It is
/// doubled for the uncertainty of the pose.
double gateVolume(const DirectedFeature& view, const PreparedMap& map, double relative_sigma,
                  double planar_gate, double scalar_gate)
{
  const Feature& feature = *view.feature;
  const double place =
      map.typicalPositionVariance(feature.type) + relative_sigma * relative_sigma + 1e-12;
  const double angle =
      feature.direction_variance + map.typicalDirectionVariance(feature.type) + 1e-12;
  constexpr double kPoseShare = 2;
  if (isSegment(feature.type))
  {
    const double offset = varianceAlong(feature, view.normal) + place;
    return kPoseShare * M_PI * planar_gate * std::sqrt(angle * offset);
  }
  const auto& p = feature.position_covariance;
  const double spread = std::sqrt((p(0, 0) + place) * (p(1, 1) + place) - p(0, 1) * p(0, 1));
  const double volume = kPoseShare * M_PI * planar_gate * spread;
  return hasBearing(feature.type) ? volume * std::min(2 * M_PI, 2 * std::sqrt(scalar_gate * angle))
                                  : volume;
}
}  // namespace

PreparedScene::PreparedScene(const std::vector<Feature>& observed, const PreparedMap& map,
                             const GeneratorOptions& options, const BinaryGates& gates)
{
  const std::size_t n = observed.size();
  views.reserve(n);
  double range = 0;
  for (const Feature& feature : observed)
  {
    views.push_back(directed(feature));
    range += std::hypot(feature.position.x, feature.position.y);
  }
  relative_sigma = map.map().error().relativeSigma(n > 0 ? range / static_cast<double>(n) : 0.0);

  for (const DirectedFeature& view : views)
  {
    const double expected = map.clutterDensity(view.type()) *
                            gateVolume(view, map, relative_sigma, gates.planar, gates.scalar);
    const double p = std::clamp(1 - std::exp(-expected), 1e-6, 0.5 * options.good_share);
    chance.push_back(p);
    hit_gain.push_back(std::log(options.good_share / p));
    miss_gain.push_back(std::log((1 - std::min(options.good_share, 0.95)) / (1 - p)));
    mean_chance += p / static_cast<double>(n);
  }

  order.resize(n * n);
  std::vector<double> distance(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    std::uint32_t* row = &order[i * n];
    for (std::size_t j = 0; j < n; ++j)
    {
      const auto between = observed[j].position - observed[i].position;
      distance[j] = dot(between, between);
      row[j] = static_cast<std::uint32_t>(j);
    }
    std::sort(row, row + n,
              [&](std::uint32_t a, std::uint32_t b)
              {
                const bool derived_a = observed[a].parent >= 0;
                const bool derived_b = observed[b].parent >= 0;
                if (derived_a != derived_b) return derived_b;
                return distance[a] != distance[b] ? distance[a] < distance[b] : a < b;
              });
  }
}

bool seesWalls(const std::vector<Feature>& observed)
{
  return std::any_of(observed.begin(), observed.end(),
                     [](const Feature& feature) { return isSegment(feature.type); });
}

bool counts(const PreparedScene& scene, const FeaturePairing& pairing,
            const std::vector<FeaturePairing>& pairings)
{
  const std::int32_t parent = scene.views[pairing.observed].feature->parent;
  if (parent < 0) return true;
  return std::none_of(pairings.begin(), pairings.end(),
                      [&](const FeaturePairing& other)
                      { return other.observed == static_cast<std::uint32_t>(parent); });
}
}  // namespace sigloc
