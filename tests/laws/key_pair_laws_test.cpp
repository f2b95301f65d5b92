// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "matching/keypoints/KeyPairSearch.h"
#include "support/simulated_office.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;
using test::MappedWorld;
using test::officeWorld;

constexpr std::size_t kAll = 100000;  // proposals

const MappedWorld& keyPairOffice()
{
  constexpr std::uint64_t kSeed = 31;
  static const MappedWorld world(officeWorld(kSeed), kSeed);
  return world;
}

KeyPairIndex indexOf(const FeatureMap& map)
{
  return KeyPairIndex(mappedKeyPoints(map), map.error());
}

bool holdsNear(const std::vector<PoseProposal>& proposals, const TPose2D& pose, double distance,
               double angle)
{
  return std::any_of(proposals.begin(), proposals.end(),
                     [&](const PoseProposal& p)
                     {
                       return std::hypot(p.x - pose.x, p.y - pose.y) < distance &&
                              std::abs(mrpt::math::wrapToPi(p.phi - pose.phi)) < angle;
                     });
}

TEST(KeyPairLaws, ProposeTheTruePose)
{
  constexpr std::uint64_t kSeed = 32;
  Random random(kSeed);
  const KeyPairIndex index = indexOf(*keyPairOffice().map());
  constexpr int kScenes = 200;
  int proposed = 0;
  int supported = 0;
  for (int k = 0; k < kScenes; ++k)
  {
    const TPose2D truth = keyPairOffice().randomPose(random);
    KeyPairSearch search(index, keyPairOffice().sceneAt(truth, random).features);
    proposed += holdsNear(search.next(kAll), truth, 0.5, 10 * M_PI / 180);
    supported += search.supportersOf(truth) >= 2;
    EXPECT_TRUE(search.finished());
    EXPECT_EQ(search.supportersOf({truth.x + 500, truth.y, truth.phi}), 0U);
  }
  // 0.96 in offices of the design study.
  EXPECT_GE(proposed, 0.96 * kScenes);
  EXPECT_GE(supported, 0.93 * kScenes);
}

// Rounds propose what a single round proposes, and the rarest pairs propose first.
TEST(KeyPairLaws, RoundsAddUp)
{
  constexpr std::uint64_t kSeed = 33;
  Random random(kSeed);
  const KeyPairIndex index = indexOf(*keyPairOffice().map());
  const ObservedScene scene = keyPairOffice().sceneAt(keyPairOffice().randomPose(random), random);
  KeyPairSearch at_once(index, scene.features);
  KeyPairSearch in_rounds(index, scene.features);
  const std::vector<PoseProposal> all = at_once.next(kAll);
  std::vector<PoseProposal> joined;
  for (std::size_t wanted = 16; !in_rounds.finished(); wanted *= 2)
  {
    const std::vector<PoseProposal> round = in_rounds.next(wanted);
    joined.insert(joined.end(), round.begin(), round.end());
  }
  ASSERT_EQ(joined.size(), all.size());
  ASSERT_FALSE(all.empty());
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    EXPECT_EQ(joined[k].x, all[k].x);
    EXPECT_EQ(joined[k].y, all[k].y);
    EXPECT_EQ(joined[k].phi, all[k].phi);
  }
}

// Supporters are counted as proposals come; all proposals compared with each other say the same.
TEST(KeyPairLaws, SupportIsThatOfTheBestSupportedPose)
{
  constexpr std::uint64_t kSeed = 36;
  Random random(kSeed);
  const KeyPairIndex index = indexOf(*keyPairOffice().map());
  constexpr std::size_t kMost = 6;
  std::size_t reached = 0;
  for (int k = 0; k < 4; ++k)
  {
    const ObservedScene scene = keyPairOffice().sceneAt(keyPairOffice().randomPose(random), random);
    KeyPairSearch search(index, scene.features);
    std::vector<PoseProposal> joined;
    for (std::size_t wanted = 4; !search.finished() && joined.size() < 2000; wanted *= 4)
    {
      const std::vector<PoseProposal> round = search.next(wanted);
      joined.insert(joined.end(), round.begin(), round.end());
      std::size_t most = 0;
      for (const PoseProposal& p : joined)
        most = std::max(most, search.supportersOf({p.x, p.y, p.phi}));
      for (std::size_t pairs = 1; pairs <= kMost; ++pairs)
        EXPECT_EQ(search.anySupportedBy(pairs), most >= pairs);
      reached = std::max(reached, most);
    }
  }
  EXPECT_GE(reached, kMost);
}

// Moving the map moves the proposals. A pair at the border of a gate or of a stored digit may
// come or go.
TEST(KeyPairLaws, ProposalsMoveWithTheMap)
{
  constexpr std::uint64_t kSeed = 34;
  Random random(kSeed);
  const TPose2D moved_from_map(37.3, -12.9, 2.1);
  std::vector<Feature> features;
  for (const Feature& feature : keyPairOffice().map()->features())
  {
    features.push_back(transformed(moved_from_map, feature));
  }
  const FeatureMap moved(std::move(features), std::nullopt, keyPairOffice().map()->error());
  const KeyPairIndex index = indexOf(*keyPairOffice().map());
  const KeyPairIndex moved_index = indexOf(moved);
  EXPECT_EQ(moved_index.range(), index.range());
  std::size_t total = 0;
  std::size_t matched = 0;
  for (int k = 0; k < 20; ++k)
  {
    const ObservedScene scene = keyPairOffice().sceneAt(keyPairOffice().randomPose(random), random);
    KeyPairSearch search(index, scene.features);
    KeyPairSearch moved_search(moved_index, scene.features);
    const std::vector<PoseProposal> in_moved = moved_search.next(kAll);
    for (const PoseProposal& p : search.next(kAll))
    {
      ++total;
      matched += holdsNear(in_moved, moved_from_map + TPose2D(p.x, p.y, p.phi), 0.01, 0.005);
    }
  }
  ASSERT_GT(total, 1000U);
  EXPECT_GE(static_cast<double>(matched), 0.98 * static_cast<double>(total));
}

TEST(KeyPairLaws, BuildingIsDeterministic)
{
  const KeyPairIndex first = indexOf(*keyPairOffice().map());
  const KeyPairIndex second = indexOf(*keyPairOffice().map());
  EXPECT_EQ(first.size(), second.size());
  constexpr std::uint64_t kSeed = 35;
  Random random(kSeed);
  for (int k = 0; k < 10; ++k)
  {
    const ObservedScene scene = keyPairOffice().sceneAt(keyPairOffice().randomPose(random), random);
    const std::vector<PoseProposal> a = KeyPairSearch(first, scene.features).next(kAll);
    const std::vector<PoseProposal> b = KeyPairSearch(second, scene.features).next(kAll);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      EXPECT_EQ(a[i].x, b[i].x);
      EXPECT_EQ(a[i].y, b[i].y);
      EXPECT_EQ(a[i].phi, b[i].phi);
    }
  }
}
}  // namespace
}  // namespace sigloc
