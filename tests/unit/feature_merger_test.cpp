// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/FeatureMerger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/wall_piece.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;
using test::wallPiece;

MapBuildingOptions twoSightings()
{
  MapBuildingOptions options;
  options.min_sightings = 2;
  return options;
}

TEST(FeatureMerger, KeepsBothFacesOfAThinWall)
{
  FeatureMerger merger(twoSightings());
  for (int k = 0; k < 3; ++k)
    merger.add({wallPiece(0, 4, 0.03, true), wallPiece(0, 4, -0.03, false)});
  const std::vector<Feature> merged = merger.features();
  ASSERT_EQ(merged.size(), 2U);
  EXPECT_NEAR(std::abs(std::remainder(merged[0].direction - merged[1].direction, 2 * M_PI)), M_PI,
              1e-9);
  for (const Feature& face : merged)
  {
    EXPECT_NEAR(face.size, 4.0, 1e-9);
    EXPECT_NEAR(face.position.y, face.direction > 0 ? 0.03 : -0.03, 1e-9);
    EXPECT_EQ(face.sightings, 3U);
  }
}

TEST(FeatureMerger, JoinsOverlappingPiecesAndDropsWhatWasSeenOnce)
{
  FeatureMerger merger(twoSightings());
  merger.add({wallPiece(0, 2, 0, true)});
  merger.add({wallPiece(1.5, 4, 0.02, true)});
  merger.add({wallPiece(3.8, 6, -0.02, true), wallPiece(0, 2, 3, true)});
  const std::vector<Feature> merged = merger.features();
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_NEAR(merged[0].size, 6.0, 0.05);
  EXPECT_NEAR(merged[0].position.x, 3.0, 0.05);
  EXPECT_EQ(merged[0].sightings, 3U);
}

TEST(FeatureMerger, MeanOfAPlaceWeighsEverySightingAlike)
{
  Feature corner;
  corner.type = FeatureType::corner;
  corner.size = M_PI / 2;
  corner.position_covariance(0, 0) = corner.position_covariance(1, 1) = 1e-4;
  FeatureMerger merger(twoSightings());
  // Two lasers see the same corner in one step: two sightings for the mean, one scan.
  std::vector<double> places = {0.0, 0.06, 0.12, 0.02};
  std::vector<Feature> step;
  for (int k = 0; k < 2; ++k)
  {
    corner.position = {places[static_cast<std::size_t>(k)], 0};
    step.push_back(corner);
  }
  merger.add(step);
  for (int k = 2; k < 4; ++k)
  {
    corner.position = {places[static_cast<std::size_t>(k)], 0};
    merger.add({corner});
  }
  const std::vector<Feature> merged = merger.features();
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_NEAR(merged[0].position.x, 0.05, 1e-12);
  EXPECT_EQ(merged[0].sightings, 3U);
}

TEST(FeatureMerger, MeanHeadingAcrossTheWrap)
{
  Feature corner;
  corner.type = FeatureType::corner;
  corner.size = M_PI / 2;
  corner.position = {1, 1};
  FeatureMerger merger(twoSightings());
  corner.direction = 3.1;
  merger.add({corner});
  corner.direction = -3.1;
  merger.add({corner});
  const std::vector<Feature> merged = merger.features();
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_NEAR(std::abs(merged[0].direction), M_PI, 1e-6);
}

/// What a merger holds that has seen all these features twice.
std::vector<Feature> seenTwice(const std::vector<Feature>& features)
{
  FeatureMerger merger(twoSightings());
  merger.add(features);
  merger.add(features);
  return merger.features();
}

TEST(FeatureMerger, MergesWhatAnUnluckyOrderLeftTwice)
{
  // The first two are too far apart to be one. What comes later draws one to the other.
  FeatureMerger merger(twoSightings());
  merger.add({wallPiece(0, 4, 0, true), wallPiece(0, 4, 0.15, true)});
  for (int k = 0; k < 8; ++k)
    merger.add({wallPiece(1, 5, 0.08, true), wallPiece(0, 3, 0.13, true)});
  ASSERT_EQ(merger.walls().size(), 2U);
  const std::vector<Feature> merged = merger.features();
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_NEAR(merged[0].size, 5, 0.01);
  EXPECT_NEAR(merged[0].position.x, 2.5, 0.01);
  EXPECT_GT(merged[0].position.y, 0.06);
  EXPECT_LT(merged[0].position.y, 0.13);
  EXPECT_EQ(merged[0].sightings, 9U);
}

TEST(FeatureMerger, APartOfAWallIsNoPost)
{
  Feature post;
  post.type = FeatureType::circle;
  post.size = 0.2;
  const auto count = [&](const Feature& wall, const TPoint2D& centre)
  {
    post.position = centre;
    return seenTwice({wall, post}).size();
  };
  const Feature wall = wallPiece(0, 4, 0, true);
  EXPECT_EQ(count(wall, {2, 0.1}), 1U);
  EXPECT_EQ(count(wall, {2, -0.25}), 1U);
  EXPECT_EQ(count(wall, {2, 0.35}), 2U);  // before the wall
  EXPECT_EQ(count(wall, {4.2, 0.1}), 2U);  // beyond its end
  EXPECT_EQ(count(wallPiece(1.8, 2.2, 0.2, true), {2, 0}), 2U);  // a face of a square post
}
}  // namespace
}  // namespace sigloc
