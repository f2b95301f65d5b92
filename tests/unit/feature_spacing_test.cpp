// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/landmarks/FeatureSpacing.h"

#include <gtest/gtest.h>

#include <vector>

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;

Feature placeAt(double x, double y, FeatureType type = FeatureType::point)
{
  Feature feature;
  feature.type = type;
  feature.position = {x, y};
  feature.position_covariance(0, 0) = feature.position_covariance(1, 1) = 1e-4;
  return feature;
}

/// Two rows of marks, 1 m apart, along each of two corridors of 40 m that meet at a right angle.
std::vector<Feature> corridors()
{
  std::vector<Feature> marks;
  for (int k = 0; k <= 20; ++k)
  {
    for (const double side : {0.0, 1.0})
    {
      marks.push_back(placeAt(2.0 * k, side));
      if (k > 0) marks.push_back(placeAt(side, 2.0 * k));
    }
  }
  return marks;
}

TEST(FeatureSpacing, TheDensityIsThatWhereTheMarksStand)
{
  const FeatureMap map(corridors(), std::nullopt, MapErrorModel{});
  const PreparedMap prepared(map);
  const FeatureSpacing spacing(prepared);
  EXPECT_NEAR(spacing.clutterDensity(FeatureType::point), 1.0 / 4.0, 1e-3);
  EXPECT_LT(prepared.clutterDensity(FeatureType::point), 1.0 / 8.0);
  EXPECT_EQ(spacing.clutterDensity(FeatureType::circle),
            prepared.clutterDensity(FeatureType::circle));
}

TEST(FeatureSpacing, OnlyWhatIsNearMarksIsMapped)
{
  const FeatureMap map(corridors(), std::nullopt, MapErrorModel{});
  const PreparedMap prepared(map);
  const FeatureSpacing spacing(prepared);
  EXPECT_TRUE(spacing.isMapped({2, 0.5}, FeatureType::point));
  EXPECT_TRUE(spacing.isMapped({41.9, 1}, FeatureType::point));
  EXPECT_FALSE(spacing.isMapped({42.1, 1}, FeatureType::point));
  EXPECT_FALSE(spacing.isMapped({20, 20}, FeatureType::point));
  EXPECT_FALSE(spacing.isMapped({1e7, -1e7}, FeatureType::point));
}

TEST(FeatureSpacing, NoNeighboursAreNoSpacing)
{
  for (const std::vector<Feature>& marks :
       {std::vector<Feature>{}, std::vector<Feature>{placeAt(1, 1)}})
  {
    const FeatureMap map(std::vector<Feature>(marks), std::nullopt, MapErrorModel{});
    const PreparedMap prepared(map);
    const FeatureSpacing spacing(prepared);
    EXPECT_TRUE(spacing.isMapped({100, 100}, FeatureType::point));
    EXPECT_EQ(spacing.clutterDensity(FeatureType::point),
              prepared.clutterDensity(FeatureType::point));
  }
}
}  // namespace
}  // namespace sigloc
