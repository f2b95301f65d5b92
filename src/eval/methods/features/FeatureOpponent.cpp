// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/features/FeatureOpponent.h"

#include <algorithm>

#include "matching/generation/PlainGenerator.h"
#include "signature/location_constraint.h"
#include "signature/unary_constraint.h"

namespace sigloc
{
namespace
{
constexpr int kTabulatedDegrees = 200;

/// Their locality: twice the neighbours that our own index keeps. That is enough for all features
/// that are seen together.
double localityOf(const PreparedMap& map, GeneratorOptions options)
{
  options.max_neighbours *= 2;
  return PairLists::cutOffFor(map, options);
}
}  // namespace

FeatureOpponent::FeatureOpponent(const FeatureMap& map, const GeneratorOptions& options,
                                 std::uint64_t budget)
    : map_(map),
      options_(options),
      chi_square_(options.gate_probability, kTabulatedDegrees),
      gates_{chi_square_(1), chi_square_(2), options.min_overlap},
      lists_(map_, localityOf(map_, options)),
      budget_(budget)
{
}

std::vector<FeatureHypothesis> FeatureOpponent::generate(const std::vector<Feature>& observed,
                                                         MatchingCounters& counters) const
{
  Query query(observed, *this, counters);
  if (query.scene.size() < 2 || map_.size() == 0) return {};
  search(query);
  counters.cut_short += query.exhausted();
  return query.ranked(baseSize(), query.bases());
}

bool FeatureOpponent::unary(const Query& query, std::uint32_t observed, std::uint32_t mapped) const
{
  ++query.counters.signature_pairs;
  return unaryCompatible(query.scene.views[observed], map_.view(mapped), gates_.scalar);
}

bool FeatureOpponent::binary(Query& query, const FeaturePairing& a, const FeaturePairing& b) const
{
  ++query.counters.checks;
  // Two observed pieces of one wall are no contradiction.
  if (a.mapped == b.mapped && !isSegment(map_.view(a.mapped).type())) return false;
  return binaryCompatible(query.scene.views[a.observed], query.scene.views[b.observed],
                          map_.view(a.mapped), map_.view(b.mapped), map_.map().error(), gates_);
}

void FeatureOpponent::gather(Query& query, const FeaturePairing& anchor, std::uint32_t j,
                             std::vector<std::uint32_t>& candidates) const
{
  ++query.counters.checks;
  gatherCandidates(query, lists_, anchor, j, candidates);
}

std::optional<FeatureOpponent::Fit> FeatureOpponent::fit(
    const Query& query, const std::vector<FeaturePairing>& pairings) const
{
  const PreparedScene& scene = query.scene;
  std::vector<DirectedPairing> directed;
  directed.reserve(pairings.size());
  for (const FeaturePairing& pairing : pairings)
  {
    directed.push_back({scene.views[pairing.observed], map_.view(pairing.mapped)});
  }
  const auto start = poseFromBase(directed.front(), directed.back(), scene.relative_sigma);
  if (!start) return std::nullopt;
  const auto pose = refinePose(*start, directed, scene.relative_sigma);
  if (!pose) return std::nullopt;
  Fit out;
  out.pose = *pose;
  const auto take = [&](const PlanarMeasurement& m)
  {
    out.distance += squaredInnovation(m, m.noise);
    out.degrees += m.degrees;
  };
  for (const DirectedPairing& pairing : directed)
  {
    take(placeMeasurement(*pose, pairing.observed, pairing.mapped, scene.relative_sigma));
    if (!hasBearing(pairing.observed.type())) continue;
    take(directionMeasurement(*pose, pairing.observed, pairing.mapped));
  }
  constexpr int kPoseDegrees = 3;
  out.degrees = std::max(1, out.degrees - kPoseDegrees);
  return out;
}

void FeatureOpponent::add(Query& query, const std::vector<FeaturePairing>& pairings,
                          const Fit& fit) const
{
  FeatureHypothesis hypothesis;
  hypothesis.pose = toGaussian(fit.pose);
  hypothesis.pairings = pairings;
  hypothesis.support = static_cast<std::uint32_t>(pairings.size());
  hypothesis.log_odds = hypothesis.support - fit.distance / chi_square_(std::max(1, fit.degrees));
  query.found.add(std::move(hypothesis));
}
}  // namespace sigloc
