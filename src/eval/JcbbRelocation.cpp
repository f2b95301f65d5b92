// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/eval/JcbbRelocation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "sigloc/matching/PlainGenerator.h"
#include "sigloc/matching/sampling.h"
#include "sigloc/matching/SplitMix.h"
#include "sigloc/signature/unary_constraint.h"

namespace sigloc
{
namespace
{
constexpr std::size_t kSampleSize = 4;  // p
constexpr double kGoodShare = 0.5;  // P_good, before anything is found
constexpr double kFailure = 0.05;  // P_fail
}  // namespace

/// One draw of observed features and the pairings found for its first ones.
struct JcbbRelocation::Search
{
  Search(const PreparedScene& observed, MatchingCounters& operations)
      : scene(observed), counters(operations), found(observed.size())
  {
  }

  const PreparedScene& scene;
  MatchingCounters& counters;
  HypothesisSet found;
  FeatureVerifier::Workspace workspace;
  std::array<std::uint32_t, kSampleSize> drawn{};
  std::size_t size = 0;
  std::array<std::uint32_t, kSampleSize> mapped{};
  std::array<std::vector<std::uint32_t>, kSampleSize> candidates;
};

JcbbRelocation::JcbbRelocation(const FeatureMap& map, const GeneratorOptions& options)
    : map_(std::make_shared<const PreparedMap>(map)),
      verifier_(map_, options),
      lists_(*map_, PairLists::cutOffFor(*map_, options))
{
}

void JcbbRelocation::extend(Search& search, std::size_t level) const
{
  if (level == search.size)
  {
    const FeaturePairing first{search.drawn[0], search.mapped[0]};
    const FeaturePairing last{search.drawn[1], search.mapped[1]};
    HypothesisBase& base = search.workspace.base;
    if (!verifier_.makeBase(search.scene, first, last, base, search.counters)) return;
    verifier_.verify(search.scene, nullptr, search.found, search.workspace, search.counters);
    return;
  }
  const BinaryGates& gates = verifier_.gates();
  const MapErrorModel& error = map_->map().error();
  for (const std::uint32_t l : search.candidates[level])
  {
    bool fits = true;
    for (std::size_t k = 1; k < level && fits; ++k)
    {
      ++search.counters.checks;
      fits = search.mapped[k] != l &&
             binaryCompatible(search.scene.views[search.drawn[k]],
                              search.scene.views[search.drawn[level]], map_->view(search.mapped[k]),
                              map_->view(l), error, gates);
    }
    if (!fits) continue;
    search.mapped[level] = l;
    extend(search, level + 1);
  }
}

std::vector<FeatureHypothesis> JcbbRelocation::generate(const std::vector<Feature>& observed,
                                                        MatchingCounters& counters) const
{
  const PreparedScene scene(observed, *map_, verifier_.options());
  const auto n = static_cast<std::uint32_t>(scene.size());
  if (n < 2) return {};
  Search search(scene, counters);
  search.size = std::min<std::size_t>(kSampleSize, n);
  SplitMix random(verifier_.options().seed);
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0U);
  const std::uint64_t before = counters.hypotheses;

  double good = kGoodShare;
  std::uint32_t draws = drawsNeeded(kFailure, std::pow(good, search.size));
  for (std::uint32_t draw = 0; draw < draws; ++draw)
  {
    random.shuffle(order);
    std::copy_n(order.begin(), search.size, search.drawn.begin());
    for (std::uint32_t k = 0; k < map_->size(); ++k)
    {
      if (!unaryCompatible(scene.views[search.drawn[0]], map_->view(k), verifier_.gates().scalar))
      {
        continue;
      }
      ++counters.signature_pairs;
      search.mapped[0] = k;
      bool complete = true;
      for (std::size_t level = 1; level < search.size && complete; ++level)
      {
        ++counters.checks;
        gatherCandidates(scene, verifier_, lists_, {search.drawn[0], k}, search.drawn[level],
                         search.candidates[level]);
        complete = !search.candidates[level].empty();
      }
      if (complete) extend(search, 1);
    }
    // The best so far tells how many of the features are good.
    good = std::max(good, static_cast<double>(search.found.bestSupport()) / n);
    draws = std::min(draws, drawsNeeded(kFailure, std::pow(good, search.size)));
  }
  return rankedHypotheses(scene, verifier_, search.found, static_cast<std::uint32_t>(search.size),
                          counters.hypotheses - before);
}
}  // namespace sigloc
