// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sigloc/features/observe_scans.h"
#include "support/hand_made_scan.h"

namespace sigloc
{
namespace
{
using test::scanByHand;
using test::Scanner;
using test::Surfaces;

std::ptrdiff_t countCircles(const ObservedScene& scene)
{
  return std::count_if(scene.features.begin(), scene.features.end(),
                       [](const Feature& feature) { return feature.type == FeatureType::circle; });
}

TEST(PostsInTheOpen, AreCirclesBeforeTheSky)
{
  Surfaces surfaces;
  surfaces.pillars = {{{1.0, 0.4}, 0.2}, {{-3.0, 2.0}, 0.2}};
  Scanner scanner;
  scanner.beams = 720;
  for (int k = 0; k < 720; k += 5)  // wherever the seam is
  {
    scanner.first_angle = -M_PI + 2 * M_PI * k / 720;
    const ObservedScene scene = observeScene({scanByHand(surfaces, {0, 0, 0}, scanner)});
    EXPECT_EQ(countCircles(scene), 2) << "seam at " << k;
  }
  // Half a turn: the field of view ends right beside one, which may go on there.
  scanner.beams = 181;
  scanner.field_of_view = M_PI;
  scanner.first_angle = std::atan2(0.4, 1.0) + 0.18;
  EXPECT_EQ(countCircles(observeScene({scanByHand(surfaces, {0, 0, 0}, scanner)})), 1);
}

TEST(PostsInTheOpen, AreNoneBesideABuilding)
{
  Surfaces surfaces;
  surfaces.pillars = {{{-3.0, 2.0}, 0.2}};
  surfaces.walls = {{{2, -1}, {2, 1}}};
  EXPECT_EQ(countCircles(observeScene({scanByHand(surfaces, {0, 0, 0})})), 0);
  surfaces.walls.clear();
  EXPECT_EQ(countCircles(observeScene({scanByHand(surfaces, {0, 0, 0})})), 1);
}

TEST(PostsInTheOpen, WhatEndsNearTheLimitOfTheRangeIsNoPost)
{
  // Only the tip of a corner is within the laser's range.
  Surfaces surfaces;
  surfaces.walls = {{{6, -4}, {4.6, 0}}, {{4.6, 0}, {6, 4}}};
  Scanner scanner;
  scanner.beams = 1440;
  scanner.max_range = 4.7;
  const ObservedScene scene = observeScene({scanByHand(surfaces, {0, 0, 0}, scanner)});
  EXPECT_GT(scene.beams.size(), 10U);
  EXPECT_EQ(countCircles(scene), 0);
}
}  // namespace
}  // namespace sigloc
