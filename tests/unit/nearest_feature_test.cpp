// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/NearestFeature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace sigloc;
using mrpt::math::TPoint2D;

namespace
{
Feature makeFeature(FeatureType type, double x, double y, double direction, double size)
{
  Feature feature;
  feature.type = type;
  feature.position = {x, y};
  feature.direction = direction;
  feature.size = size;
  return feature;
}
}  // namespace

TEST(NearestFeature, FindsPlacesOnSegmentsCirclesAndPoints)
{
  // A wall along x from 0 to 4 whose free side is up.
  const Feature wall = makeFeature(FeatureType::segment, 2, 0, M_PI / 2, 4);
  EXPECT_NEAR((nearestPlaceOn(wall, {1, 3}) - TPoint2D(1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((nearestPlaceOn(wall, {9, 1}) - TPoint2D(4, 0)).norm(), 0, 1e-12);
  const Feature pillar = makeFeature(FeatureType::circle, 1, 1, 0, 0.5);
  EXPECT_NEAR((nearestPlaceOn(pillar, {1, 5}) - TPoint2D(1, 1.5)).norm(), 0, 1e-12);
  EXPECT_NEAR((nearestPlaceOn(pillar, {1, 1}) - TPoint2D(1.5, 1)).norm(), 0, 1e-12);
  const Feature corner = makeFeature(FeatureType::corner, 3, 4, 1, 1.5);
  EXPECT_EQ(nearestPlaceOn(corner, {0, 0}), TPoint2D(3, 4));
}

TEST(NearestFeature, AgreesWithASearchOfAllFeatures)
{
  std::mt19937_64 random(20120214);
  std::uniform_real_distribution<double> place(-30, 30);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  std::uniform_real_distribution<double> size(0.1, 9);
  std::vector<Feature> features;
  for (int i = 0; i < 200; ++i)
  {
    const auto type = static_cast<FeatureType>(i % 5);
    features.push_back(
        makeFeature(type, place(random), place(random), angle(random),
                    type == FeatureType::circle ? 0.1 * size(random) : size(random)));
  }
  const NearestFeature nearest(features);
  std::size_t found = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const TPoint2D point(place(random), place(random));
    const double radius = 0.1 * size(random) + (i % 3);
    double best = radius;
    bool any = false;
    for (const Feature& feature : features)
    {
      const double distance = (nearestPlaceOn(feature, point) - point).norm();
      if (distance > best) continue;
      best = distance;
      any = true;
    }
    const auto hit = nearest.find(point, radius);
    ASSERT_EQ(hit.has_value(), any);
    if (!hit) continue;
    ++found;
    EXPECT_DOUBLE_EQ(hit->distance, best);
    EXPECT_EQ(hit->place, nearestPlaceOn(features[hit->feature], point));
  }
  EXPECT_GT(found, 500U);
}

TEST(NearestFeature, FindsNothingInAnEmptyMap)
{
  EXPECT_FALSE(NearestFeature({}).find({0, 0}, 5));
}
