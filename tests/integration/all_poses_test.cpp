// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "eval/worlds/FeatureWorld.h"
#include "matching/generators.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

/// A room that is in the map several times, each copy turned, moved and lacking a few features.
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

constexpr std::array<std::uint64_t, 4> kRoomSeeds = {61, 62, 63, 64};

/// The poses that the plain mode finds and the other modes miss, without those that the background
/// explains.
struct Missed
{
  std::size_t plausible = 0;
  std::map<GenerationMode, std::size_t> by_mode;

  void ask(const FeatureMap& map, const std::vector<Feature>& observed)
  {
    const GeneratorOptions options;
    MatchingCounters counters;
    const auto reference =
        makeGenerator(GenerationMode::plain, map, options)->generate(observed, counters);
    for (const GenerationMode mode :
         {GenerationMode::anchors, GenerationMode::pairs, GenerationMode::patterns})
    {
      const auto found = makeGenerator(mode, map, options)->generate(observed, counters);
      for (const FeatureHypothesis& hypothesis : reference)
      {
        if (hypothesis.chance >= options.significance) continue;
        plausible += mode == GenerationMode::anchors;
        by_mode[mode] += !holds(found, hypothesis.pose.mean);
      }
    }
  }
};

// All good poses count, not only the best one: in a repetitive building the missing one may be the
// robot's.
TEST(AllPoses, OfOneToEightCopiesOfARoomAreFound)
{
  Missed missed;
  for (const std::uint64_t seed : kRoomSeeds)
  {
    Random random(seed);
    for (std::size_t copies = 1; copies <= 8; ++copies)
    {
      for (int round = 0; round < 6; ++round)
      {
        FeatureWorldOptions world;
        world.range = 6;
        if (round % 2 == 1) world.type_weights = {2, 1, 1, 1, 1};
        const FeatureWorld room = makeFeatureWorld(40, world, random);
        const FeatureMap map(copiesOf(room, copies, random));
        missed.ask(map, observeFeatures(room, randomPose(room, world, random), world, random, 14));
      }
    }
  }
  EXPECT_GE(missed.plausible, 720U);
  const double bar = GeneratorOptions{}.failure_probability * static_cast<double>(missed.plausible);
  EXPECT_LE(static_cast<double>(missed.by_mode[GenerationMode::anchors]), bar);
  EXPECT_LE(static_cast<double>(missed.by_mode[GenerationMode::pairs]), bar);
  EXPECT_LE(static_cast<double>(missed.by_mode[GenerationMode::patterns]), bar);
}
}  // namespace
}  // namespace sigloc
