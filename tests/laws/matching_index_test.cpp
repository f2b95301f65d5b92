// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "eval/worlds/FeatureWorld.h"
#include "matching/features/FeatureGrid.h"
#include "matching/features/FeatureQuery.h"
#include "matching/features/PairLists.h"
#include "matching/generation/pattern_order.h"
#include "matching/generation/PatternIndex.h"
#include "matching/generation/PlainGenerator.h"
#include "matching/generators.h"
#include "signature/unary_constraint.h"

namespace sigloc
{
namespace
{
/// Returns the places of a feature and of the `size` - 1 nearest to it, which are a pattern.
std::array<mrpt::math::TPoint2D, kLargestPattern> patternAround(const PreparedMap& map,
                                                                std::uint32_t root,
                                                                std::size_t size)
{
  std::vector<std::uint32_t> nearest(map.size());
  std::iota(nearest.begin(), nearest.end(), 0U);
  const auto distance = [&](std::uint32_t k)
  { return (map.view(k).position() - map.view(root).position()).norm(); };
  std::sort(nearest.begin(), nearest.end(),
            [&](std::uint32_t a, std::uint32_t b) { return distance(a) < distance(b); });
  std::array<mrpt::math::TPoint2D, kLargestPattern> places;
  for (std::size_t k = 0; k < size; ++k) places[k] = map.view(nearest[k]).position();
  return places;
}

TEST(PatternIndex, LookUpEqualsBruteForce)
{
  Random random(22);
  const FeatureWorld world = makeFeatureWorld(60, {}, random);
  const FeatureMap feature_map(world.mapped);
  const PreparedMap map(feature_map);
  GeneratorOptions options;
  for (const std::uint32_t size : {3U, 4U, 5U})
  {
    options.pattern_size = size;
    const PatternIndex index(map, options);
    ASSERT_GT(index.count(), 100U);
    EXPECT_LT(static_cast<double>(index.bytes()) / 60, 1200.0);
    PatternShape shape;
    PatternIndex::Gate wide{0.3, 1e9};
    std::size_t found = 0;
    std::size_t expected = 0;
    for (std::uint32_t root = 0; root < map.size(); root += 7)
    {
      const auto at = patternAround(map, root, size);
      const PatternOrder order = canonicalOrder(at.data(), size);
      std::array<mrpt::math::TPoint2D, kLargestPattern> ordered;
      for (std::size_t k = 0; k < size; ++k) ordered[k] = at[order[k]];
      shape = PatternIndex::shapeOf(ordered.data(), size);
      index.visit(shape, wide,
                  [&](const std::uint32_t* members)
                  {
                    std::array<mrpt::math::TPoint2D, kLargestPattern> other;
                    for (std::size_t k = 0; k < size; ++k)
                      other[k] = map.view(members[k]).position();
                    const PatternShape stored = PatternIndex::shapeOf(other.data(), size);
                    for (std::size_t v = 0; v < 2 * size - 3; ++v)
                    {
                      EXPECT_NEAR(stored.values[v], shape.values[v], 0.31);
                    }
                    ++found;
                  });
      // A shape is always found under itself when its pattern is indexed; count by a scan.
      index.visitAll(
          [&](const std::uint32_t* members)
          {
            std::array<mrpt::math::TPoint2D, kLargestPattern> other;
            for (std::size_t k = 0; k < size; ++k) other[k] = map.view(members[k]).position();
            const PatternShape stored = PatternIndex::shapeOf(other.data(), size);
            bool fits = true;
            for (std::size_t v = 0; v < 2 * size - 3; ++v)
            {
              fits = fits && std::abs(stored.values[v] - shape.values[v]) < 0.299;
            }
            expected += fits;
          });
    }
    EXPECT_GT(expected, 0U);
    EXPECT_GE(found, expected);
  }
}

TEST(PairLists, BinarySearchEqualsBruteForce)
{
  FeatureWorldOptions options;
  options.range = 6;
  options.type_weights = {1, 2, 1, 1, 1};
  Random random(19);
  const FeatureWorld world = makeFeatureWorld(80, options, random);
  const FeatureMap feature_map(world.mapped);
  const auto map = std::make_shared<const PreparedMap>(feature_map);
  const FeatureVerifier verifier(map, {});
  const PairLists lists(*map, PairLists::kUncut);
  const auto observed = observeFeatures(world, randomPose(world, options, random), options, random);
  MatchingCounters counters;
  FeatureQuery query(observed, verifier, counters);
  const PreparedScene& scene = query.scene;
  std::vector<std::uint32_t> candidates;
  std::size_t total = 0;
  for (std::uint32_t i = 0; i < scene.size(); ++i)
  {
    for (std::uint32_t k = 0; k < map->size(); ++k)
    {
      if (map->view(k).type() != scene.views[i].type()) continue;
      for (std::uint32_t j = 0; j < scene.size(); ++j)
      {
        if (j == i) continue;
        gatherCandidates(query, lists, {i, k}, j, candidates);
        std::vector<std::uint32_t> expected;
        for (std::uint32_t l = 0; l < map->size(); ++l)
        {
          const bool fits =
              l != k && unaryCompatible(scene.views[j], map->view(l), verifier.gates().scalar) &&
              binaryCompatible(scene.views[i], scene.views[j], map->view(k), map->view(l),
                               feature_map.error(), verifier.gates());
          if (fits) expected.push_back(l);
        }
        std::sort(candidates.begin(), candidates.end());
        ASSERT_EQ(candidates, expected);
        total += expected.size();
      }
    }
  }
  EXPECT_GT(total, 100U);
  EXPECT_GT(counters.visits, total);  // whatever is found was read
}

TEST(FeatureGrid, TellsHowMuchItReads)
{
  Random random(23);
  const FeatureWorld world = makeFeatureWorld(60, {}, random);
  const FeatureGrid grid(world.mapped);
  const auto type = world.mapped.front().type;
  std::uint64_t visited = 0;
  const auto count = [&](std::uint32_t) { ++visited; };
  // 60 features are in 16 x 16 cells, the least power of two that has twice as many.
  EXPECT_EQ(grid.visitNear({0, 0}, 1e3, type, count), 16U * 16U + 60U);
  EXPECT_EQ(visited, 60U);
  // A small reach touches one to four cells, and the few features that are in them.
  const std::uint64_t read = grid.visitNear(world.mapped.front().position, 0.01, type, count);
  EXPECT_GE(read, 2U);
  EXPECT_LT(read, 20U);
}

TEST(MatchingCounters, EveryCheckOfAnIndexedModeIsReadFromTheIndex)
{
  FeatureWorldOptions options;
  Random random(24);
  const FeatureWorld world = makeFeatureWorld(300, options, random);
  const FeatureMap map(world.mapped);
  const auto pose = randomPose(world, options, random);
  const auto observed = observeFeatures(world, pose, options, random, 12);
  for (const auto mode : {GenerationMode::anchors, GenerationMode::pairs, GenerationMode::patterns})
  {
    MatchingCounters counters;
    makeGenerator(mode, map)->generate(observed, counters);
    EXPECT_GT(counters.checks, 0U) << static_cast<int>(mode);
    EXPECT_GE(counters.visits, counters.checks) << static_cast<int>(mode);
  }
}
}  // namespace
}  // namespace sigloc
