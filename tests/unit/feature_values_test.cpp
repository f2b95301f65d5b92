// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/feature_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <vector>

#include "map/NearestFeature.h"
#include "sigloc/features/observe_scans.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/HypothesisTracker.h"

namespace sigloc
{
namespace
{
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

LaserScan oddScan(std::mt19937& random)
{
  const float odd[] = {0.0F,
                       -1.0F,
                       0.3F,
                       2.0F,
                       2.01F,
                       30.0F,
                       9999.0F,
                       1e38F,
                       std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity()};
  LaserScan scan;
  const std::size_t n = 2 + random() % 200;
  scan.first_angle = -3.0;
  scan.angle_step = 6.0 / static_cast<double>(n);
  scan.max_range = 1e4;
  scan.range_sigma = random() % 2 == 0 ? 0.01 : 1.0;
  scan.robot_from_sensor = {0.2, -0.1, 0.3};
  float range = 3;
  for (std::size_t i = 0; i < n; ++i)
  {
    if (random() % 10 == 0) range = odd[random() % 10];
    scan.ranges.push_back(range);
    scan.valid.push_back(random() % 7 != 0);
  }
  return scan;
}

ObservedScene soundScene()
{
  ObservedScene scene;
  scene.sensor_origins = {{0.1, 0.0}};
  for (int i = 0; i < 60; ++i) scene.beams.push_back({{3.0, 0.05 * i}, 0});
  Feature corner;
  corner.type = FeatureType::corner;
  corner.size = 1.5;
  corner.position_covariance(0, 0) = corner.position_covariance(1, 1) = 1e-4;
  scene.features = {corner, corner};
  return scene;
}

TEST(FeatureValues, WhatIsSeenInAnyScanIsSound)
{
  std::mt19937 random(20120228);
  for (int k = 0; k < 500; ++k) EXPECT_NO_THROW(checkScene(observeScene({oddScan(random)}))) << k;
}

using Spoil = std::function<void(ObservedScene&)>;

const std::vector<Spoil>& spoilers()
{
  static const std::vector<Spoil> kSpoilers = {
      [](ObservedScene& s) { s.beams[7].origin = 1; },
      [](ObservedScene& s) { s.beams[7].origin = 0xFFFFFFFFU; },
      [](ObservedScene& s) { s.beams[7].point.x = kNan; },
      [](ObservedScene& s) { s.beams[7].point.y = 1e30; },
      [](ObservedScene& s) { s.sensor_origins[0].x = kNan; },
      [](ObservedScene& s) { s.sensor_origins.clear(); },
      [](ObservedScene& s) { s.features[1].parent = 2; },
      [](ObservedScene& s) { s.features[1].parent = 0x7ffffff0; },
      [](ObservedScene& s) { s.features[1].parent = -7; },
      [](ObservedScene& s) { s.features[0].position.x = kNan; },
      [](ObservedScene& s) { s.features[0].direction = 1e300; },
      [](ObservedScene& s) { s.features[0].size = -1; },
      [](ObservedScene& s) { s.features[0].type = FeatureType::count; },
      [](ObservedScene& s) { s.features[0].position_covariance(0, 1) = 3; },
      [](ObservedScene& s) { s.features[0].size_variance = kNan; },
  };
  return kSpoilers;
}

TEST(FeatureValues, EveryFlawOfASceneIsRefused)
{
  EXPECT_NO_THROW(checkScene(soundScene()));
  for (std::size_t k = 0; k < spoilers().size(); ++k)
  {
    ObservedScene scene = soundScene();
    spoilers()[k](scene);
    EXPECT_THROW(checkScene(scene), std::invalid_argument) << k;
  }
}

TEST(FeatureValues, LocalizeAndStepRefuseWhatTheyCannotUse)
{
  Feature post;
  post.position_covariance(0, 0) = post.position_covariance(1, 1) = 1e-4;
  std::vector<Feature> posts(6, post);
  for (std::size_t k = 0; k < posts.size(); ++k)
  {
    posts[k].position = {1.7 * static_cast<double>(k), static_cast<double>(k * k % 5)};
  }
  const auto matcher =
      std::make_shared<const SignatureMatcher>(std::make_shared<const FeatureMap>(posts));
  HypothesisTracker tracker(matcher);
  for (std::size_t k = 0; k < spoilers().size(); ++k)
  {
    ObservedScene scene = soundScene();
    spoilers()[k](scene);
    EXPECT_THROW(matcher->localize(scene), std::invalid_argument) << k;
    EXPECT_THROW(matcher->propose(scene), std::invalid_argument) << k;
    EXPECT_THROW(tracker.step(std::nullopt, scene), std::invalid_argument) << k;
  }
  EXPECT_NO_THROW(tracker.step(std::nullopt, soundScene()));
}

TEST(NearestFeature, FindsTheSameInAnyCircle)
{
  std::mt19937 random(20120229);
  std::uniform_real_distribution<double> place(-50, 50);
  std::vector<Feature> features(300);
  for (Feature& feature : features)
  {
    feature.type = random() % 2 == 0 ? FeatureType::segment : FeatureType::circle;
    feature.position = {place(random), place(random)};
    feature.direction = 0.06 * place(random);
    feature.size = 0.5 + 0.01 * std::abs(place(random));
  }
  const NearestFeature nearest(features);
  for (int k = 0; k < 200; ++k)
  {
    const mrpt::math::TPoint2D point(place(random), place(random));
    const auto far = nearest.find(point, 1e9);
    ASSERT_TRUE(far);
    const auto near = nearest.find(point, 9);
    if (far->distance > 9) continue;
    ASSERT_TRUE(near);
    EXPECT_EQ(near->feature, far->feature);
    EXPECT_EQ(near->distance, far->distance);
  }
  EXPECT_FALSE(nearest.find({kNan, 0}, 1));
}
}  // namespace
}  // namespace sigloc
