// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include "eval/worlds/FeatureWorld.h"
#include "matching/features/FeatureVerifier.h"
#include "matching/features/PairLists.h"
#include "matching/generation/PlainGenerator.h"
#include "matching/generators.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

bool near(const TPose2D& a, const TPose2D& b, double distance, double angle)
{
  return std::hypot(a.x - b.x, a.y - b.y) < distance &&
         std::abs(mrpt::math::wrapToPi(a.phi - b.phi)) < angle;
}

std::vector<FeatureHypothesis> generate(GenerationMode mode, const FeatureMap& map,
                                        const std::vector<Feature>& observed,
                                        MatchingCounters* counters = nullptr)
{
  MatchingCounters own;
  return makeGenerator(mode, map)->generate(observed, counters ? *counters : own);
}

std::vector<Feature> moved(const TPose2D& motion, const std::vector<Feature>& features)
{
  std::vector<Feature> out;
  for (const Feature& feature : features) out.push_back(transformed(motion, feature));
  return out;
}

/// Map features mirrored at the y axis: chirality reversed, distances kept.
std::vector<Feature> mirrored(const std::vector<Feature>& features)
{
  std::vector<Feature> out = features;
  for (Feature& feature : out)
  {
    feature.position.x = -feature.position.x;
    feature.position_covariance(0, 1) = -feature.position_covariance(0, 1);
    feature.position_covariance(1, 0) = -feature.position_covariance(1, 0);
    if (hasDirection(feature.type))
    {
      feature.direction = mrpt::math::wrapToPi(M_PI - feature.direction);
    }
    if (traitsOf(feature.type).has_side)
    {
      feature.side = feature.side == WallSide::start ? WallSide::end : WallSide::start;
    }
    std::swap(feature.start_seen, feature.end_seen);
  }
  return out;
}

FeatureWorldOptions smallScenes(bool every_type)
{
  FeatureWorldOptions options;
  options.range = 6;
  if (every_type) options.type_weights = {1, 2, 1, 1, 1};
  return options;
}

class GeneratorLaws : public testing::TestWithParam<GenerationMode>
{
};

std::string modeName(const testing::TestParamInfo<GenerationMode>& info)
{
  switch (info.param)
  {
    case GenerationMode::plain:
      return "Plain";
    case GenerationMode::anchors:
      return "Anchors";
    case GenerationMode::pairs:
      return "Pairs";
    case GenerationMode::patterns:
      return "Patterns";
    default:
      return "Automatic";
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, GeneratorLaws,
                         testing::Values(GenerationMode::plain, GenerationMode::anchors,
                                         GenerationMode::pairs, GenerationMode::patterns),
                         modeName);

TEST_P(GeneratorLaws, FindsThePoseAmongPointsAndAmongEveryType)
{
  for (const bool every_type : {false, true})
  {
    const FeatureWorldOptions options = smallScenes(every_type);
    Random random(11);
    const FeatureWorld world = makeFeatureWorld(150, options, random);
    const FeatureMap map(world.mapped);
    const auto generator = makeGenerator(GetParam(), map);
    int right = 0;
    constexpr int kPoses = 20;
    for (int k = 0; k < kPoses; ++k)
    {
      const TPose2D truth = randomPose(world, options, random);
      MatchingCounters counters;
      const auto found =
          generator->generate(observeFeatures(world, truth, options, random, 14), counters);
      right += !found.empty() && near(found[0].pose.mean, truth, 0.3, 0.06);
      for (const FeatureHypothesis& hypothesis : found)
      {
        EXPECT_TRUE(inverse(toSymmetric(hypothesis.pose.covariance)));
      }
    }
    EXPECT_GE(right, kPoses - 1) << (every_type ? "every type" : "points");
  }
}

TEST_P(GeneratorLaws, IsEquivariant)
{
  const FeatureWorldOptions options = smallScenes(true);
  Random random(12);
  const FeatureWorld world = makeFeatureWorld(80, options, random);
  const TPose2D truth = randomPose(world, options, random);
  const auto observed = observeFeatures(world, truth, options, random, 12);
  const TPose2D a(3.0, -7.0, 2.5);
  const TPose2D b(-0.4, 0.9, -1.9);
  const auto plain = generate(GetParam(), FeatureMap(world.mapped), observed);
  const auto both = generate(GetParam(), FeatureMap(moved(a, world.mapped)), moved(b, observed));
  ASSERT_FALSE(plain.empty());
  ASSERT_FALSE(both.empty());
  // Map moved by A and observation by B give A (+) x (+) B^-1.
  const TPose2D expected = a + plain[0].pose.mean + (TPose2D(0, 0, 0) - b);
  EXPECT_TRUE(near(both[0].pose.mean, expected, 0.02, 0.005));
}

TEST_P(GeneratorLaws, OrderOfTheMapDoesNotMatter)
{
  const FeatureWorldOptions options = smallScenes(true);
  Random random(13);
  const FeatureWorld world = makeFeatureWorld(80, options, random);
  const TPose2D truth = randomPose(world, options, random);
  const auto observed = observeFeatures(world, truth, options, random, 12);
  std::vector<Feature> reversed(world.mapped.rbegin(), world.mapped.rend());
  const auto one = generate(GetParam(), FeatureMap(world.mapped), observed);
  const auto two = generate(GetParam(), FeatureMap(reversed), observed);
  ASSERT_FALSE(one.empty());
  ASSERT_FALSE(two.empty());
  EXPECT_TRUE(near(one[0].pose.mean, two[0].pose.mean, 1e-6, 1e-6));
  EXPECT_EQ(one[0].support, two[0].support);
}

TEST_P(GeneratorLaws, MirrorImageEmptyAndForeignMapsGiveNothingSignificant)
{
  const FeatureWorldOptions options = smallScenes(false);
  Random random(14);
  const FeatureWorld world = makeFeatureWorld(100, options, random);
  const FeatureWorld foreign = makeFeatureWorld(100, options, random);
  const FeatureMap image(mirrored(world.mapped));
  const FeatureMap other(foreign.mapped);
  int significant = 0;
  for (int k = 0; k < 5; ++k)
  {
    const TPose2D truth = randomPose(world, options, random);
    const auto observed = observeFeatures(world, truth, options, random, 14);
    for (const FeatureMap* map : {&image, &other})
    {
      for (const FeatureHypothesis& hypothesis : generate(GetParam(), *map, observed))
      {
        significant += hypothesis.chance < GeneratorOptions{}.significance;
      }
    }
    EXPECT_TRUE(generate(GetParam(), FeatureMap(), observed).empty());
  }
  EXPECT_EQ(significant, 0);
}

TEST_P(GeneratorLaws, CopiesOfARoomGiveEqualCandidates)
{
  const FeatureWorldOptions options = smallScenes(true);
  Random random(15);
  const FeatureWorld room = makeFeatureWorld(30, options, random);
  constexpr std::size_t kCopies = 3;
  std::vector<Feature> features;
  for (std::size_t copy = 0; copy < kCopies; ++copy)
  {
    // Whole powers of two keep the copies exact in floating point.
    const TPose2D shift(64.0 * static_cast<double>(copy), 0, 0);
    for (const Feature& feature : moved(shift, room.mapped)) features.push_back(feature);
  }
  const TPose2D truth = randomPose(room, options, random);
  const auto observed = observeFeatures(room, truth, options, random, 14);
  const auto found = generate(GetParam(), FeatureMap(features), observed);
  ASSERT_GE(found.size(), kCopies);
  for (std::size_t copy = 0; copy < kCopies; ++copy)
  {
    EXPECT_NEAR(found[copy].log_odds, found[0].log_odds, 1e-6);
    EXPECT_EQ(found[copy].support, found[0].support);
    EXPECT_NEAR(found[copy].pose.mean.x - truth.x,
                64.0 * std::round((found[copy].pose.mean.x - truth.x) / 64.0), 0.5);
  }
  for (std::size_t k = kCopies; k < found.size(); ++k)
  {
    EXPECT_LT(found[k].log_odds, found[0].log_odds - 1);
  }
}

TEST_P(GeneratorLaws, DegenerateInputGivesNoErrorAndNoNonsense)
{
  const FeatureWorldOptions options = smallScenes(true);
  Random random(16);
  const FeatureWorld world = makeFeatureWorld(40, options, random);
  const auto generator_map = FeatureMap(world.mapped);
  const auto generator = makeGenerator(GetParam(), generator_map);
  MatchingCounters counters;
  EXPECT_TRUE(generator->generate({}, counters).empty());
  const auto observed = observeFeatures(world, randomPose(world, options, random), options, random);
  EXPECT_TRUE(generator->generate({observed[0]}, counters).empty());
  generator->generate({observed[0], observed[1]}, counters);

  // Coincident and collinear points, exact: no covariance at all.
  std::vector<Feature> line;
  for (int k = 0; k < 8; ++k)
  {
    Feature point;
    point.position = {static_cast<double>(k / 2), 0};
    point.position_covariance.setZero();
    line.push_back(point);
  }
  const FeatureMap line_map(line);
  for (const FeatureHypothesis& hypothesis : generate(GetParam(), line_map, line))
  {
    EXPECT_TRUE(std::isfinite(hypothesis.log_odds));
    EXPECT_TRUE(inverse(toSymmetric(hypothesis.pose.covariance)));
  }
}

TEST_P(GeneratorLaws, HeadingsAtPiAndLinesThroughTheOrigin)
{
  FeatureWorldOptions options = smallScenes(true);
  options.spurious = 0.1;
  Random random(17);
  FeatureWorld world = makeFeatureWorld(60, options, random);
  const FeatureMap map(moved(TPose2D(-0.5 * world.side, -0.5 * world.side, 0), world.mapped));
  for (const double heading : {M_PI, -M_PI, M_PI - 1e-9, 0.0})
  {
    const TPose2D truth(0.5 * world.side, 0.5 * world.side, heading);
    const auto observed = observeFeatures(world, truth, options, random, 14);
    const auto found = generate(GetParam(), map, observed);
    ASSERT_FALSE(found.empty());
    EXPECT_TRUE(near(found[0].pose.mean, TPose2D(0, 0, heading), 0.3, 0.06));
    EXPECT_LE(std::abs(found[0].pose.mean.phi), M_PI + 1e-12);
  }
}

TEST_P(GeneratorLaws, SameSeedSameResult)
{
  const FeatureWorldOptions options = smallScenes(true);
  Random random(18);
  const FeatureWorld world = makeFeatureWorld(60, options, random);
  const FeatureMap map(world.mapped);
  const auto observed = observeFeatures(world, randomPose(world, options, random), options, random);
  const auto generator = makeGenerator(GetParam(), map);
  MatchingCounters counters;
  const auto one = generator->generate(observed, counters);
  const auto two = generator->generate(observed, counters);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t k = 0; k < one.size(); ++k)
  {
    EXPECT_EQ(one[k].log_odds, two[k].log_odds);
    EXPECT_EQ(one[k].pose.mean.x, two[k].pose.mean.x);
  }
}

TEST(GeneratorRecall, SamplingModesFindTheSignificantPosesOfThePlainMode)
{
  // Worlds with two partial copies of an area, so that there are several poses to find.
  FeatureWorldOptions options = smallScenes(false);
  Random random(21);
  const double significance = GeneratorOptions{}.significance;
  int wanted = 0;
  std::array<int, 3> missed{};
  constexpr std::array<GenerationMode, 3> kModes{GenerationMode::anchors, GenerationMode::pairs,
                                                 GenerationMode::patterns};
  for (int round = 0; round < 12; ++round)
  {
    const FeatureWorld room = makeFeatureWorld(40, options, random);
    std::vector<Feature> features = room.mapped;
    for (const Feature& feature : moved(TPose2D(40, 5, 1.0), room.mapped))
    {
      if (!random.chance(0.05)) features.push_back(feature);
    }
    const FeatureMap map(features);
    const auto observed =
        observeFeatures(room, randomPose(room, options, random), options, random, 14);
    const auto reference = generate(GenerationMode::plain, map, observed);
    for (std::size_t mode = 0; mode < kModes.size(); ++mode)
    {
      const auto found = generate(kModes[mode], map, observed);
      for (const FeatureHypothesis& hypothesis : reference)
      {
        if (hypothesis.chance >= significance) continue;
        wanted += mode == 0;
        missed[mode] +=
            std::none_of(found.begin(), found.end(),
                         [&](const FeatureHypothesis& other)
                         { return near(other.pose.mean, hypothesis.pose.mean, 0.3, 0.06); });
      }
    }
  }
  EXPECT_GE(wanted, 18);
  for (const int count : missed) EXPECT_LE(count, 1);
}

TEST(PatternGenerator, FallsBackToPairsAmongWalls)
{
  // Patterns consist of places alone. Where mostly walls are seen, pairs must find the robot.
  FeatureWorldOptions options = smallScenes(false);
  options.type_weights = {0, 4, 0, 1, 0};
  Random random(22);
  const FeatureWorld world = makeFeatureWorld(150, options, random);
  const FeatureMap map(world.mapped);
  const auto generator = makeGenerator(GenerationMode::patterns, map);
  int right = 0;
  constexpr int kPoses = 20;
  for (int k = 0; k < kPoses; ++k)
  {
    const TPose2D truth = randomPose(world, options, random);
    MatchingCounters counters;
    const auto found =
        generator->generate(observeFeatures(world, truth, options, random, 10), counters);
    right += !found.empty() && near(found[0].pose.mean, truth, 0.3, 0.06);
  }
  EXPECT_GE(right, kPoses - 2);
}

/// Points on a square lattice, 2 m apart, where every distance recurs.
std::vector<Feature> latticeOf(int side)
{
  std::vector<Feature> lattice;
  for (int k = 0; k < side * side; ++k)
  {
    Feature point;
    point.position = {2.0 * (k % side), 2.0 * (k / side)};
    point.position_covariance.setIdentity();
    point.position_covariance *= 1e-4;
    lattice.push_back(point);
  }
  return lattice;
}

TEST(PlainGenerator, TakesTimeInProportionToTheMap)
{
  // Four times the map: at the rim of the smaller one many neighbours are missing, so a bit more
  // than four times the work. What is quadratic would take sixteen times as much.
  const std::vector<Feature> scene = latticeOf(3);
  std::vector<MatchingCounters> counters;
  for (const int side : {7, 14})
  {
    const FeatureMap feature_map(latticeOf(side));
    const auto map = std::make_shared<const PreparedMap>(feature_map);
    const auto verifier = std::make_shared<const FeatureVerifier>(map, GeneratorOptions{});
    const auto lists = std::make_shared<const PairLists>(*map, PairLists::kUncut);
    PlainGenerator(verifier, lists).generate(scene, counters.emplace_back());
  }
  EXPECT_GT(counters[0].hypotheses, 0U);
  EXPECT_LT(counters[1].hypotheses, 8 * counters[0].hypotheses);
  EXPECT_LT(counters[1].checks, 8 * counters[0].checks);
  EXPECT_LT(counters[1].visits, 8 * counters[0].visits);
}

TEST(PlainGenerator, EndsAtItsBudgetAndProvesNothingThen)
{
  const FeatureMap map(latticeOf(14));
  GeneratorOptions options;
  const std::vector<Feature> scene = latticeOf(3);
  MatchingCounters whole;
  makeGenerator(GenerationMode::plain, map, options)->generate(scene, whole);
  EXPECT_EQ(whole.cut_short, 0U);
  options.plain_operations = (whole.checks + whole.visits) / 10;
  MatchingCounters cut;
  const auto found = makeGenerator(GenerationMode::plain, map, options)->generate(scene, cut);
  EXPECT_EQ(cut.cut_short, 1U);
  EXPECT_LT(cut.checks + cut.visits, 2 * options.plain_operations);
  EXPECT_FALSE(found.empty());
  for (const FeatureHypothesis& hypothesis : found) EXPECT_GE(hypothesis.chance, 1.0);
}

TEST(PlainGenerator, RefusesMapsWhosePairsDoNotFitInMemory)
{
  const FeatureMap map(latticeOf(101));
  EXPECT_THROW(makeGenerator(GenerationMode::plain, map), std::invalid_argument);
}
}  // namespace
}  // namespace sigloc
