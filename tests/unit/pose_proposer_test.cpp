// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/PoseProposer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sigloc/map/FeatureMap.h"
#include "support/wall_between.h"

namespace sigloc
{
namespace
{
using test::wallBetween;

bool anyAtOrigin(const std::vector<PoseProposal>& proposals)
{
  return std::any_of(proposals.begin(), proposals.end(),
                     [](const PoseProposal& p)
                     {
                       return std::hypot(p.x, p.y) < 0.3F &&
                              std::abs(std::remainder(p.phi, 2 * static_cast<float>(M_PI))) < 0.1F;
                     });
}

TEST(PoseProposer, SlidesAParallelWallWhereTheLongestIsMappedFromItsOtherSide)
{
  // The robot looks at a thin wall on its right and at a shorter one farther off, parallel to it.
  // The mapping robot saw the first from behind.
  const PoseProposer proposer(
      FeatureMap({wallBetween({2, -1.1}, {-2, -1.1}), wallBetween({-4, -5}, {4, -5})}));
  const std::vector<Feature> observed = {wallBetween({-1.5, -1}, {1.5, -1}),
                                         wallBetween({-1, -5}, {1, -5})};
  EXPECT_TRUE(anyAtOrigin(proposer.proposeFurther(observed)));
}

TEST(PoseProposer, SlidesPiecesOfOneWallOnce)
{
  const PoseProposer proposer(FeatureMap({wallBetween({-8, -5}, {8, -5})}));
  const std::vector<Feature> one = {wallBetween({-3, -5}, {0, -5})};
  const std::vector<Feature> two = {one.front(), wallBetween({1, -5}, {3, -5})};
  // The longest is slid before.
  EXPECT_TRUE(proposer.proposeFurther(one).empty());
  EXPECT_TRUE(proposer.proposeFurther(two).empty());
  EXPECT_TRUE(anyAtOrigin(proposer.propose(two)));
}
}  // namespace
}  // namespace sigloc
