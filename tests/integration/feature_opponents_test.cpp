// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "eval/methods/features/CliqueAssociation.h"
#include "eval/methods/features/InterpretationTree.h"
#include "eval/methods/features/JcbbRelocation.h"
#include "eval/worlds/FeatureWorld.h"
#include "signature/location_constraint.h"
#include "signature/unary_constraint.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

struct SmallCase
{
  FeatureWorld world;
  TPose2D truth;
  std::vector<Feature> observed;
};

/// A world so small that every interpretation can be listed, of points or of every type.
SmallCase smallCase(std::uint64_t seed, bool every_type)
{
  FeatureWorldOptions options;
  options.range = 5;
  options.detection = 1;
  if (every_type) options.type_weights = {1, 1, 1, 1, 1};
  Random random(seed);
  SmallCase out;
  out.world = makeFeatureWorld(8, options, random);
  out.truth = randomPose(out.world, options, random);
  out.observed = observeFeatures(out.world, out.truth, options, random, 6);
  return out;
}

/// Joint squared Mahalanobis distance of pairings by its definition, with one large matrix: the
/// residuals at the pose `x`, the pose taken out by weighted least squares.
double jointDistance(const PreparedScene& scene, const PreparedMap& map,
                     const std::vector<FeaturePairing>& pairings, const PoseEstimate& x,
                     int& degrees)
{
  std::vector<PlanarMeasurement> measured;
  for (const FeaturePairing& p : pairings)
  {
    const DirectedFeature& observed = scene.views[p.observed];
    measured.push_back(placeMeasurement(x, observed, map.view(p.mapped), scene.relative_sigma));
    if (!hasBearing(observed.type())) continue;
    measured.push_back(directionMeasurement(x, observed, map.view(p.mapped)));
  }
  const auto rows = static_cast<Eigen::Index>(2 * measured.size());
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(rows, 3);
  Eigen::MatrixXd r = Eigen::MatrixXd::Identity(rows, rows);
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(rows);
  degrees = -3;
  for (std::size_t k = 0; k < measured.size(); ++k)
  {
    const PlanarMeasurement& m = measured[k];
    const auto at = static_cast<Eigen::Index>(2 * k);
    degrees += m.degrees;
    for (Eigen::Index row = 0; row < 2; ++row)
    {
      const auto index = static_cast<std::size_t>(row);
      residual(at + row) = m.residual[index];
      for (Eigen::Index c = 0; c < 3; ++c)
      {
        h(at + row, c) = m.jacobian[index][static_cast<std::size_t>(c)];
      }
    }
    r(at, at) = m.noise.xx;
    r(at, at + 1) = r(at + 1, at) = m.noise.xy;
    r(at + 1, at + 1) = m.noise.yy;
  }
  degrees = std::max(1, degrees);
  const Eigen::MatrixXd weight = r.inverse();
  const Eigen::MatrixXd information = h.transpose() * weight * h;
  const Eigen::VectorXd taken = information.ldlt().solve(h.transpose() * weight * residual);
  const Eigen::VectorXd rest = residual - h * taken;
  return rest.dot(weight * rest);
}

/// Calls visit(pairings) for every interpretation that unary and binary constraints allow.
template <class Visit>
void listInterpretations(const PreparedScene& scene, const PreparedMap& map,
                         std::vector<FeaturePairing>& pairings, std::uint32_t level, Visit&& visit)
{
  if (level == scene.size()) return visit(pairings);
  const BinaryGates gates;
  for (std::uint32_t k = 0; k < map.size(); ++k)
  {
    bool fits = unaryCompatible(scene.views[level], map.view(k), gates.scalar);
    for (const FeaturePairing& p : pairings)
    {
      fits = fits && (p.mapped != k || isSegment(map.view(k).type())) &&
             binaryCompatible(scene.views[p.observed], scene.views[level], map.view(p.mapped),
                              map.view(k), map.map().error(), gates);
    }
    if (!fits) continue;
    pairings.push_back({level, k});
    listInterpretations(scene, map, pairings, level + 1, visit);
    pairings.pop_back();
  }
  listInterpretations(scene, map, pairings, level + 1, visit);
}

template <class Method>
std::vector<FeatureHypothesis> ask(const FeatureMap& map, const std::vector<Feature>& observed)
{
  MatchingCounters counters;
  return Method(map, GeneratorOptions{}).generate(observed, counters);
}

class FeatureOpponents : public testing::TestWithParam<bool>
{
};
INSTANTIATE_TEST_SUITE_P(Worlds, FeatureOpponents, testing::Bool(),
                         [](const auto& world) { return world.param ? "EveryType" : "Points"; });

TEST_P(FeatureOpponents, TreeAndCliqueFindTheLargestInterpretationOfBruteForce)
{
  for (std::uint64_t seed = 100; seed < 125; ++seed)
  {
    SCOPED_TRACE(seed);
    const SmallCase small = smallCase(seed, GetParam());
    const FeatureMap map(small.world.mapped);
    const PreparedMap prepared(map);
    const PreparedScene scene(small.observed, prepared, {}, {});
    std::size_t largest = 0;
    std::vector<FeaturePairing> pairings;
    listInterpretations(scene, prepared, pairings, 0,
                        [&](const std::vector<FeaturePairing>& found)
                        { largest = std::max(largest, found.size()); });
    const auto tree = ask<InterpretationTree>(map, small.observed);
    const auto cliques = ask<CliqueAssociation>(map, small.observed);
    for (const auto* found : {&tree, &cliques})
    {
      if (found->empty())
      {
        // Too small to count, or a mirror image that no pose fits.
        EXPECT_TRUE(largest < GeneratorOptions{}.min_support || !tree.empty());
        continue;
      }
      EXPECT_LE(found->front().support, largest);
      EXPECT_EQ(found->front().support, found->front().pairings.size());
    }
    if (!tree.empty() && tree.front().support == largest)
    {
      ASSERT_FALSE(cliques.empty());
      EXPECT_EQ(cliques.front().support, largest);
    }
  }
}

TEST_P(FeatureOpponents, EveryAnswerIsJointlyCompatibleByDefinition)
{
  int right = 0;
  int answers = 0;
  for (std::uint64_t seed = 200; seed < 220; ++seed)
  {
    SCOPED_TRACE(seed);
    const SmallCase small = smallCase(seed, GetParam());
    const FeatureMap map(small.world.mapped);
    const PreparedMap prepared(map);
    const PreparedScene scene(small.observed, prepared, {}, {});
    const auto jcbb = ask<JcbbRelocation>(map, small.observed);
    const auto tree = ask<InterpretationTree>(map, small.observed);
    const auto cliques = ask<CliqueAssociation>(map, small.observed);
    for (const auto* found : {&jcbb, &tree, &cliques})
    {
      for (const FeatureHypothesis& hypothesis : *found)
      {
        int degrees = 0;
        const double distance = jointDistance(scene, prepared, hypothesis.pairings,
                                              toEstimate(hypothesis.pose), degrees);
        EXPECT_LE(distance, chiSquareGate(GeneratorOptions{}.gate_probability, degrees) + 1e-6);
      }
      if (found->empty()) continue;
      ++answers;
      const auto& pose = found->front().pose.mean;
      right += std::hypot(pose.x - small.truth.x, pose.y - small.truth.y) < 0.5;
    }
    // Jcbb never pairs more than the whole tree does.
    if (!tree.empty() && !jcbb.empty())
    {
      EXPECT_LE(jcbb.front().support, tree.front().support);
    }
  }
  EXPECT_GE(answers, 45);
  EXPECT_GE(right, answers * 8 / 10);
}

TEST_P(FeatureOpponents, BranchAndBoundPairsAtLeastAsMuchAsNearestNeighbours)
{
  int found = 0;
  for (std::uint64_t seed = 300; seed < 330; ++seed)
  {
    SCOPED_TRACE(seed);
    const SmallCase small = smallCase(seed, GetParam());
    const FeatureMap map(small.world.mapped);
    MatchingCounters counters;
    const auto whole = JcbbRelocation(map, {}, {0.25, false}).generate(small.observed, counters);
    const auto greedy = JcbbRelocation(map, {}, {0.25, true}).generate(small.observed, counters);
    if (greedy.empty()) continue;
    ASSERT_FALSE(whole.empty());
    EXPECT_GE(whole.front().support, greedy.front().support);
    ++found;
  }
  EXPECT_GE(found, 20);
}

TEST(FeatureOpponentBudgets, ABudgetEndsTheSearchAndIsReported)
{
  FeatureWorldOptions options;
  Random random(41);
  const FeatureWorld world = makeFeatureWorld(300, options, random);
  const FeatureMap map(world.mapped);
  const auto observed = observeFeatures(world, randomPose(world, options, random), options, random);
  constexpr std::uint64_t kSmallBudget = 5000;
  const JcbbRelocation jcbb(map, {}, {}, kSmallBudget);
  const InterpretationTree tree(map, {}, kSmallBudget);
  const CliqueAssociation clique(map, {}, kSmallBudget);
  for (const FeatureHypothesisGenerator* method :
       std::initializer_list<const FeatureHypothesisGenerator*>{&jcbb, &tree, &clique})
  {
    MatchingCounters counters;
    method->generate(observed, counters);
    EXPECT_EQ(counters.cut_short, 1U);
    EXPECT_LT(counters.checks + counters.signature_pairs, 4 * kSmallBudget);
  }
  MatchingCounters counters;
  JcbbRelocation(map, {}).generate(observed, counters);
  EXPECT_EQ(counters.cut_short, 0U);
}

TEST(FeatureOpponentBudgets, NothingComesOfNothing)
{
  Random random(42);
  const FeatureWorld world = makeFeatureWorld(20, {}, random);
  for (const FeatureMap& map : {FeatureMap(), FeatureMap(world.mapped)})
  {
    EXPECT_TRUE(ask<JcbbRelocation>(map, {}).empty());
    EXPECT_TRUE(ask<InterpretationTree>(map, {}).empty());
    EXPECT_TRUE(ask<CliqueAssociation>(map, {world.truth[0]}).empty());
  }
}
}  // namespace
}  // namespace sigloc
