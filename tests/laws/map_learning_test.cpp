// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
// A map that is learnt scan by scan, in a simulated office.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bridge/sample_maps.h"
#include "map/building/MapBuilder.h"
#include "map/NearestFeature.h"
#include "support/simulated_office.h"

using namespace sigloc;
using namespace sigloc::test;
using mrpt::math::TPose2D;

namespace
{
const MappedWorld& learnedOffice()
{
  static const MappedWorld world(makeWorld(WorldKind::office, {}, 5), 5);
  return world;
}

std::vector<PosedScans> mappingScans()
{
  return simulateMapping(learnedOffice().world(), 1.2, 0.35, MappedWorld::laser(), 5);
}

/// Share of the features of `a` that `b` has within 10 cm, of their kind, facing their way.
double shareFoundIn(const FeatureMap& a, const FeatureMap& b)
{
  std::size_t found = 0;
  for (const Feature& feature : a.features())
  {
    const auto same = [&](const Feature& other)
    {
      return other.type == feature.type && std::cos(other.direction - feature.direction) > 0.9 &&
             (nearestPlaceOn(other, feature.position) - feature.position).norm() < 0.1;
    };
    found += std::any_of(b.features().begin(), b.features().end(), same);
  }
  return static_cast<double>(found) / static_cast<double>(a.features().size());
}

/// First answers of both maps to the same scenes, where either is sure.
void expectSameAnswers(const FeatureMap& a, const FeatureMap& b)
{
  const SignatureMatcher in_a(std::make_shared<FeatureMap>(a));
  const SignatureMatcher in_b(std::make_shared<FeatureMap>(b));
  Random random(31, 0);
  constexpr int kScenes = 20;
  int same = 0;
  for (int i = 0; i < kScenes; ++i)
  {
    const ObservedScene scene = learnedOffice().sceneAt(learnedOffice().randomPose(random), random);
    const auto at_a = in_a.localize(scene);
    const auto at_b = in_b.localize(scene);
    ASSERT_FALSE(at_a.candidates.empty());
    ASSERT_FALSE(at_b.candidates.empty());
    const TPose2D& p = at_a.candidates.front().pose.mean;
    const TPose2D& q = at_b.candidates.front().pose.mean;
    same += std::hypot(p.x - q.x, p.y - q.y) < 0.05 && std::cos(p.phi - q.phi) > 0.999;
  }
  EXPECT_GE(same, kScenes - 1);
}
}  // namespace

TEST(MapLearning, IsTheSameInOneGoOrOneByOne)
{
  const std::vector<PosedScans> scans = mappingScans();
  MapBuilder builder;
  for (std::size_t i = 0; i < scans.size(); ++i)
  {
    builder.add(scans[i]);
    if (i % 3 == 0) builder.field();
  }
  test::expectSameMap(builder.map(), *learnedOffice().map());
}

TEST(MapLearning, DependsLittleOnTheOrder)
{
  std::vector<PosedScans> scans = mappingScans();
  std::mt19937 random(17);
  std::shuffle(scans.begin(), scans.end(), random);
  const FeatureMap shuffled = buildMapFromScans(scans);
  test::expectSameField(*shuffled.field(), *learnedOffice().map()->field());
  EXPECT_GE(shareFoundIn(shuffled, *learnedOffice().map()), 0.95);
  EXPECT_GE(shareFoundIn(*learnedOffice().map(), shuffled), 0.95);
  expectSameAnswers(shuffled, *learnedOffice().map());
}

TEST(MapLearning, WorkGrowsWithTheScansNotWithTheirSquare)
{
  const std::vector<PosedScans> scans = mappingScans();
  MapBuilder builder;
  std::uint64_t half = 0;
  for (std::size_t i = 0; i < scans.size(); ++i)
  {
    builder.add(scans[i]);
    builder.field();
    if (i + 1 == scans.size() / 2) half = builder.cellsCounted() + builder.cellsSolved();
  }
  const std::uint64_t all = builder.cellsCounted() + builder.cellsSolved();
  EXPECT_LT(static_cast<double>(all), 2.5 * static_cast<double>(half));
}
