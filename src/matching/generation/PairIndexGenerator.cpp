// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/generation/PairIndexGenerator.h"

#include "matching/generation/sampling.h"
#include "signature/unary_constraint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sigloc
{
/// An observed pair with the mapped pairs that fit its key.
struct PairIndexGenerator::Lookup
{
  std::uint32_t i;
  std::uint32_t j;
  double length;  ///< [m], of the base
  PairIndex::Runs runs;
};

PairIndexGenerator::PairIndexGenerator(std::shared_ptr<const FeatureVerifier> verifier,
                                       std::shared_ptr<const PairLists> lists)
    : verifier_(std::move(verifier)), lists_(std::move(lists)), index_(verifier_->map(), *lists_)
{
}

/// Looks up every pair of the given features within the cut-off.
std::vector<PairIndexGenerator::Lookup> PairIndexGenerator::lookupsAmong(
    const PreparedScene& scene, const std::vector<std::uint32_t>& among) const
{
  const MapErrorModel& error = verifier_->map().map().error();
  const double gate = verifier_->gates().scalar;
  std::vector<Lookup> lookups;
  for (std::size_t a = 0; a < among.size(); ++a)
  {
    for (std::size_t b = a + 1; b < among.size(); ++b)
    {
      const DirectedFeature& first = scene.views[among[a]];
      const DirectedFeature& second = scene.views[among[b]];
      const auto between = second.position() - first.position();
      const double length = std::hypot(between.x, between.y);
      const double reach =
          lists_->cutOff() + 0.5 * (first.length() + second.length());  // between extents
      if (length > reach) continue;
      const BinaryKey key = binaryKey(first, second);
      const double tolerance =
          keyTolerance(key, lists_->largestKeyVariance(first.type(), second.type()), error, gate);
      lookups.push_back(
          {among[a], among[b], length, index_.find(first.type(), second.type(), key, tolerance)});
    }
  }
  return lookups;
}

/// Short bases give poor headings. They are kept where fewer than `count` long ones are left.
std::vector<PairIndexGenerator::Lookup> PairIndexGenerator::longerHalf(std::vector<Lookup> lookups,
                                                                       std::size_t count)
{
  const auto middle = lookups.begin() + static_cast<std::ptrdiff_t>(lookups.size() / 2);
  std::nth_element(lookups.begin(), middle, lookups.end(),
                   [](const Lookup& a, const Lookup& b) { return a.length > b.length; });
  if (lookups.size() / 2 >= count) lookups.erase(middle, lookups.end());
  return lookups;
}

/// Rare pairs come first. Of a feature in more than `fair` of them, which may be spurious, the
/// others come last.
std::vector<PairIndexGenerator::Lookup> PairIndexGenerator::fairChoice(std::vector<Lookup> lookups,
                                                                       std::size_t features,
                                                                       std::size_t fair)
{
  std::sort(lookups.begin(), lookups.end(),
            [](const Lookup& a, const Lookup& b)
            {
              const auto pairs_a = a.runs.pairs();
              const auto pairs_b = b.runs.pairs();
              if (pairs_a != pairs_b) return pairs_a < pairs_b;
              return a.i != b.i ? a.i < b.i : a.j < b.j;
            });
  std::vector<std::size_t> used(features, 0);
  std::vector<Lookup> chosen;
  std::vector<Lookup> rest;
  for (const Lookup& lookup : lookups)
  {
    const bool overused = used[lookup.i] >= fair || used[lookup.j] >= fair;
    (overused ? rest : chosen).push_back(lookup);
    if (overused) continue;
    ++used[lookup.i];
    ++used[lookup.j];
  }
  chosen.insert(chosen.end(), rest.begin(), rest.end());
  return chosen;
}

std::vector<PairIndexGenerator::Lookup> PairIndexGenerator::rankedLookups(
    const PreparedScene& scene, const std::vector<std::uint32_t>& among, std::uint32_t count) const
{
  const std::size_t fair = 1 + 2 * count / std::max<std::size_t>(1, among.size());
  std::vector<Lookup> chosen =
      fairChoice(longerHalf(lookupsAmong(scene, among), count), scene.size(), fair);
  if (chosen.size() > count) chosen.resize(count);
  return chosen;
}

void PairIndexGenerator::tryLookup(FeatureQuery& query, const Lookup& lookup,
                                   std::uint64_t limit) const
{
  const PreparedMap& map = query.map;
  const BinaryGates& gates = query.gates;
  const MapErrorModel& error = map.map().error();
  const DirectedFeature& first = query.scene.views[lookup.i];
  const DirectedFeature& second = query.scene.views[lookup.j];
  index_.visit(lookup.runs,
               [&](std::uint32_t k, std::uint32_t l)
               {
                 ++query.counters.signature_pairs;
                 if (query.counters.hypotheses >= limit) return;
                 const bool fits =
                     unaryCompatible(first, map.view(k), gates.scalar) &&
                     unaryCompatible(second, map.view(l), gates.scalar) &&
                     binaryCompatible(first, second, map.view(k), map.view(l), error, gates);
                 if (!fits || !verifier_->makeBase(query, {lookup.i, k}, {lookup.j, l})) return;
                 verifier_->verify(query);
               });
}

std::vector<PairIndexGenerator::Lookup> PairIndexGenerator::lookupsOfAll(
    const PreparedScene& scene) const
{
  const GeneratorOptions& options = verifier_->options();
  std::vector<std::uint32_t> everything(scene.size());
  std::iota(everything.begin(), everything.end(), 0U);
  const std::uint32_t draws =
      drawsNeeded(options.failure_probability, std::pow(options.good_share, 2));
  return rankedLookups(scene, everything, draws);
}

std::uint64_t PairIndexGenerator::basesFor(const PreparedScene& scene) const
{
  return basesOf(lookupsOfAll(scene));
}

std::uint64_t PairIndexGenerator::basesOf(const std::vector<Lookup>& lookups)
{
  std::uint64_t bases = 0;
  for (const Lookup& lookup : lookups) bases += lookup.runs.pairs();
  return bases;
}

void PairIndexGenerator::search(FeatureQuery& query, std::uint64_t budget) const
{
  const std::uint64_t before = query.bases();
  const std::uint64_t counted = query.counters.hypotheses;
  const std::uint64_t limit =
      budget > std::numeric_limits<std::uint64_t>::max() - counted ? budget : counted + budget;
  const auto significant = [&] { return query.isSignificant(2, query.bases() - before); };

  // 1. Rare, long pairs of all features, until an answer is significant.
  for (const Lookup& lookup : lookupsOfAll(query.scene))
  {
    if (query.counters.hypotheses >= limit) return;
    tryLookup(query, lookup, limit);
    if (significant()) break;
  }
  if (!significant()) return;

  // 2. Pairs of what the answer explains, because look-alike poses share most of it.
  for (const Lookup& lookup : lookupsOfExplained(query)) tryLookup(query, lookup, limit);
}

std::vector<PairIndexGenerator::Lookup> PairIndexGenerator::lookupsOfExplained(
    const FeatureQuery& query) const
{
  const std::vector<std::uint32_t> explained = observedOf(*query.found.best());
  const double failure = query.options.failure_probability;
  return rankedLookups(query.scene, explained,
                       drawsNeeded(failure, rivalShare(explained.size(), 2)));
}

void PairIndexGenerator::searchAgain(FeatureQuery& query, std::uint64_t budget) const
{
  const std::vector<Lookup> lookups = lookupsOfExplained(query);
  if (basesOf(lookups) > budget) return;
  const std::uint64_t limit = query.counters.hypotheses + budget;
  for (const Lookup& lookup : lookups) tryLookup(query, lookup, limit);
}

std::vector<FeatureHypothesis> PairIndexGenerator::generate(const std::vector<Feature>& observed,
                                                            MatchingCounters& counters) const
{
  FeatureQuery query(observed, *verifier_, counters);
  search(query, std::numeric_limits<std::uint64_t>::max());
  return query.ranked(2, query.bases());
}
}  // namespace sigloc
