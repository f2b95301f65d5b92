// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/generation/PatternQuery.h"

#include "matching/generation/sampling.h"
#include "signature/unary_constraint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
// Share of the patterns of mapped features around a robot that the index has. It lacks those whose
// members are not near neighbours of each other in the map. Eta of eq. (4.10)
constexpr double kIndexedShare = 0.5;
// The same where nothing was found: in a sparse map, the neighbours of what is seen are out of
// sight. Eta of eq. (4.10)
constexpr double kSparselyIndexedShare = 0.05;
constexpr double kFewExpected = 0.5;  // E of (5.12) below which an answer that explains w is enough
constexpr double kBetterThanBackground = 1;  // E of (5.12) below which an answer counts, eq. (4.10)
constexpr std::uint64_t kFewPairBases = 2000;  // that may be tried where patterns are too few
// P_fail of the second round of draws. More draws cost less than smaller bases, or than no sure
// answer. In a sparse map few of the patterns seen are indexed.
constexpr double kDrawsAreCheap = 1e-6;

/// True when the best answer is significant, or when it explains the share w of the features and
/// has E < 1/2. Then more or smaller bases find no better answer, even where too few features were
/// seen for significance.
bool settles(const FeatureQuery& query, std::uint32_t base_size)
{
  const FeatureHypothesis* best = query.found.best();
  if (!best) return false;
  const double chance = query.expectedByChance(best->support, base_size, query.bases());
  const bool explains_enough =
      best->support >= query.options.good_share * static_cast<double>(query.scene.size());
  return chance < query.options.significance || (explains_enough && chance < kFewExpected);
}
}  // namespace

PatternGenerator::PatternGenerator(std::shared_ptr<const FeatureVerifier> verifier,
                                   std::shared_ptr<const PairLists> lists)
    : verifier_(verifier),
      index_(verifier->map(), verifier->options()),
      residual_gate_(chiSquareGate(verifier->options().gate_probability,
                                   std::max(1, 2 * static_cast<int>(index_.patternSize()) - 3))),
      pairs_(verifier, lists),
      anchors_(verifier, lists)
{
}

bool PatternGenerator::fitPattern(const Query& query, const PatternMembers& observed,
                                  const std::uint32_t* mapped, PoseEstimate& pose) const
{
  const PreparedScene& scene = query.scene;
  const std::size_t size = index_.patternSize();
  std::array<TPoint2D, kLargestPattern> seen;
  std::array<TPoint2D, kLargestPattern> known;
  for (std::size_t k = 0; k < size; ++k)
  {
    const DirectedFeature& view = query.map.view(mapped[k]);
    if (!unaryCompatible(scene.views[observed[k]], view, query.gates.scalar)) return false;
    seen[k] = scene.views[observed[k]].position();
    known[k] = view.position();
  }
  const auto fitted = poseFromPlaces(seen.data(), known.data(), size, query.variance);
  if (!fitted) return false;
  pose = *fitted;
  return true;
}

void PatternGenerator::tryPattern(Query& query) const
{
  const PreparedScene& scene = query.scene;
  const PreparedMap& map = query.map;
  MatchingCounters& counters = query.counters;
  HypothesisBase& base = query.workspace.base;
  const std::size_t size = index_.patternSize();
  for (const PatternOrder& order : query.orders)
  {
    std::array<TPoint2D, kLargestPattern> ordered;
    PatternMembers observed{};
    for (std::size_t k = 0; k < size; ++k)
    {
      observed[k] = query.members[order[k]];
      ordered[k] = scene.views[observed[k]].position();
    }
    // There are three passes, so that the memory of one hit is fetched while others are processed.
    ++counters.signature_pairs;
    query.hits.clear();
    const auto keep = [&](const std::uint32_t* mapped)
    {
      for (std::size_t k = 0; k < size; ++k) map.prefetch(mapped[k]);
      query.hits.push_back(mapped);
    };
    counters.visits += index_.visit(PatternIndex::shapeOf(ordered.data(), size), query.gate, keep);
    counters.hypotheses += query.hits.size();
    query.poses.clear();
    const TPoint2D next = scene.views[scene.orderFrom(observed[0])[1]].position();
    std::size_t kept = 0;
    for (const std::uint32_t* mapped : query.hits)
    {
      PoseEstimate pose;
      if (leadsToPartners(query, observed, mapped)) continue;
      if (!fitPattern(query, observed, mapped, pose)) continue;
      map.grid().prefetch(pose.place(next));
      query.poses.push_back(pose);
      query.hits[kept++] = mapped;
    }
    for (std::size_t h = 0; h < kept; ++h)
    {
      base.pose = query.poses[h];
      base.pairings.clear();
      for (std::size_t k = 0; k < size; ++k)
      {
        base.pairings.push_back({observed[k], query.hits[h][k]});
      }
      verifier_->verify(query);
    }
  }
}

/// Draws patterns of `roots` until `wanted` new ones are tried or `done` returns true. Every draw
/// starts at another feature. Patterns that could be written in many orders wait until the others
/// are used up. A draw without a new pattern is repeated, but not for ever: few features have few
/// patterns.
template <class Done>
std::uint32_t PatternGenerator::draw(const std::vector<std::uint32_t>& roots, std::uint32_t wanted,
                                     Query& query, const Done& done) const
{
  constexpr std::uint32_t kPatience = 3;
  constexpr std::size_t kFewOrders = 2;
  std::vector<bool> among(query.scene.size(), false);
  for (const std::uint32_t root : roots) among[root] = true;
  std::uint32_t fresh = 0;
  for (const std::size_t most_orders : {kFewOrders, std::numeric_limits<std::size_t>::max()})
  {
    for (std::uint32_t d = 0; d < kPatience * wanted && fresh < wanted; ++d)
    {
      if (!drawPattern(among, roots[d % roots.size()], most_orders, query)) continue;
      ++fresh;
      const std::uint64_t bases = query.bases();
      tryPattern(query);
      if (query.bases() > bases && done()) return fresh;
    }
  }
  return fresh;
}

/// Returns whether the best answer needs no smaller bases.
bool PatternGenerator::search(Query& query) const
{
  const PreparedScene& scene = query.scene;
  const auto size = static_cast<std::uint32_t>(index_.patternSize());
  std::vector<std::uint32_t> places;
  for (std::uint32_t i = 0; i < scene.size(); ++i)
  {
    if (isPointLike(scene.views[i].type())) places.push_back(i);
  }
  if (size == 0 || places.size() < size) return false;
  query.random.shuffle(places);

  // 1. Patterns of all features, until an answer is significant.
  const auto significant = [&] { return query.isSignificant(size, query.bases()); };
  const double good = kIndexedShare * std::pow(query.options.good_share, size);
  for (const double failure : {query.options.failure_probability, kDrawsAreCheap})
  {
    draw(places, drawsNeeded(failure, good), query, significant);
    if (settles(query, size)) break;
  }
  if (!settles(query, size)) return false;

  // 2. Patterns of what the answer explains.
  searchAgain(query);
  return true;
}

/// Look-alike poses share most of what the best one explains. Only patterns that the index has at
/// the best pose are drawn, because most likely it has them at look-alike poses too. Where there
/// are too few of them, pairs are looked up.
void PatternGenerator::searchAgain(Query& query) const
{
  query.partners.assign(query.scene.size(), 0);
  for (const FeaturePairing& pairing : query.found.best()->pairings)
  {
    query.partners[pairing.observed] = pairing.mapped;
  }
  std::vector<std::uint32_t> explained;
  for (const std::uint32_t i : observedOf(*query.found.best()))
  {
    if (isPointLike(query.scene.views[i].type())) explained.push_back(i);
  }
  const double shared = rivalShare(explained.size(), index_.patternSize());
  const std::uint32_t wanted = drawsNeeded(query.options.failure_probability, shared);
  std::uint32_t drawn = 0;
  if (!explained.empty())
  {
    // The smaller of the two is an integer that fits; the number of patterns alone may not.
    const double patterns = combinations(explained.size(), index_.patternSize());
    const auto draws = static_cast<std::uint32_t>(std::min<double>(patterns, wanted));
    drawn = draw(explained, draws, query, [] { return false; });
  }
  if (drawn >= wanted) return;
  const std::uint64_t before = query.bases();
  pairs_.searchAgain(query, kFewPairBases);
  query.pair_bases = query.bases() - before;
}

/// Smaller bases find poses that share too few features with the map for patterns. They are worth
/// their cost on two conditions. The budget must be enough for all of them. And some support that
/// the draws may have missed must beat both the best answer and the background. Eq. (4.10)
bool PatternGenerator::smallerBasesMayHelp(const Query& query) const
{
  const PreparedScene& scene = query.scene;
  const GeneratorOptions& options = query.options;
  const auto n = static_cast<std::uint32_t>(scene.size());
  // Patterns do not use walls, pairs do.
  if (seesWalls(query.observed)) return true;
  const std::uint64_t bases = pairs_.basesFor(scene);
  if (bases > options.fall_back_hypotheses) return false;
  const double indexed = query.found.best() ? kIndexedShare : kSparselyIndexedShare;
  for (std::uint32_t support = std::max(query.found.bestSupport() + 1, options.min_support);
       support <= n; ++support)
  {
    const double good = indexed * shareOfPatterns(scene, support);
    const double missed = std::pow(1 - good, static_cast<double>(query.tried.size()));
    if (missed > options.failure_probability &&
        query.expectedByChance(support, 2, bases) < kBetterThanBackground)
    {
      return true;
    }
  }
  return false;
}

/// Returns the share of the patterns of all places seen that consist of mapped places, if `support`
/// of the features are mapped. Eq. (4.10)
double PatternGenerator::shareOfPatterns(const PreparedScene& scene, std::uint32_t support) const
{
  const std::size_t size = index_.patternSize();
  const auto places = static_cast<double>(std::count_if(scene.views.begin(), scene.views.end(),
                                                        [](const DirectedFeature& view)
                                                        { return isPointLike(view.type()); }));
  if (size == 0 || places < static_cast<double>(size)) return 0;
  const double supporting = places * support / static_cast<double>(scene.size());
  double share = 1;
  for (std::size_t k = 0; k < size; ++k)
  {
    const auto taken = static_cast<double>(k);
    share *= std::max(0.0, supporting - taken) / (places - taken);
  }
  return share;
}

std::vector<FeatureHypothesis> PatternGenerator::generate(const std::vector<Feature>& observed,
                                                          MatchingCounters& counters) const
{
  Query query(observed, *verifier_, counters);
  double mapped = 0;
  for (std::size_t t = 0; t < kFeatureTypes; ++t)
  {
    const auto type = static_cast<FeatureType>(t);
    if (isPointLike(type)) mapped = std::max(mapped, query.map.typicalPositionVariance(type));
  }
  const double relative_sigma = query.scene.relative_sigma;
  query.map_variance = mapped + relative_sigma * relative_sigma + 1e-12;

  if (search(query) || !smallerBasesMayHelp(query))
  {
    const auto base_size = static_cast<std::uint32_t>(index_.patternSize());
    return query.ranked(base_size, query.bases() - query.pair_bases);
  }
  // Without a sure answer, smaller bases find poses that share few features with the map.
  const std::uint64_t budget = query.options.fall_back_hypotheses;
  pairs_.search(query, budget);
  const bool sure =
      seesWalls(query.observed) ? query.isSignificant(2, query.bases()) : settles(query, 2);
  if (!sure) anchors_.search(query, budget);
  return query.ranked(2, query.bases());
}
}  // namespace sigloc
