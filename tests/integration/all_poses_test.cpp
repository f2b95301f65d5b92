// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "sigloc/eval/FeatureWorld.h"
#include "sigloc/matching/generators.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

/// A room that stands in the map several times, each copy turned, moved and lacking a few features.
std::vector<Feature> copiesOf(const FeatureWorld& room, std::size_t copies, Random& random)
{
  constexpr double kApart = 40;  // [m], more than the room is wide
  constexpr double kLost = 0.05;  // share of a copy's features that it lacks
  std::vector<Feature> features;
  for (std::size_t copy = 0; copy < copies; ++copy)
  {
    const TPose2D place(kApart * static_cast<double>(copy), 0, random.uniform(-M_PI, M_PI));
    for (const Feature& feature : room.mapped)
    {
      if (!random.chance(kLost)) features.push_back(transformed(place, feature));
    }
  }
  return features;
}

bool holds(const std::vector<FeatureHypothesis>& found, const TPose2D& pose)
{
  return std::any_of(found.begin(), found.end(),
                     [&](const FeatureHypothesis& other)
                     {
                       const TPose2D& p = other.pose.mean;
                       return std::hypot(p.x - pose.x, p.y - pose.y) < 0.3 &&
                              std::abs(mrpt::math::wrapToPi(p.phi - pose.phi)) < 0.06;
                     });
}

class AllPoses : public testing::TestWithParam<GenerationMode>
{
};
INSTANTIATE_TEST_SUITE_P(Modes, AllPoses,
                         testing::Values(GenerationMode::anchors, GenerationMode::pairs,
                                         GenerationMode::patterns),
                         [](const auto& mode)
                         {
                           return mode.param == GenerationMode::anchors ? "Anchors"
                                  : mode.param == GenerationMode::pairs ? "Pairs"
                                                                        : "Patterns";
                         });

// Every pose that the plain mode finds and that isn't chance, not just the winner: where a building
// repeats itself, the one that is left out may be the robot's.
TEST_P(AllPoses, OfOneToEightCopiesOfARoomAreFound)
{
  GeneratorOptions options;
  std::size_t plausible = 0;
  std::size_t missed = 0;
  Random random(61);
  for (std::size_t copies = 1; copies <= 8; ++copies)
  {
    for (int round = 0; round < 6; ++round)
    {
      FeatureWorldOptions world;
      world.range = 6;
      if (round % 2 == 1) world.type_weights = {2, 1, 1, 1, 1};
      const FeatureWorld room = makeFeatureWorld(40, world, random);
      const FeatureMap map(copiesOf(room, copies, random));
      const auto observed =
          observeFeatures(room, randomPose(room, world, random), world, random, 14);
      MatchingCounters counters;
      const auto reference =
          makeGenerator(GenerationMode::plain, map, options)->generate(observed, counters);
      const auto found = makeGenerator(GetParam(), map, options)->generate(observed, counters);
      for (const FeatureHypothesis& hypothesis : reference)
      {
        if (hypothesis.chance >= options.significance) continue;
        ++plausible;
        missed += !holds(found, hypothesis.pose.mean);
      }
    }
  }
  EXPECT_GE(plausible, 180U);
  EXPECT_LE(static_cast<double>(missed),
            options.failure_probability * static_cast<double>(plausible))
      << "of " << plausible;
}
}  // namespace
}  // namespace sigloc
