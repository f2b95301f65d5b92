// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros1/OdometryTrack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sigloc::ros1
{
namespace
{
constexpr double kPatience = 0.2;

TEST(OdometryTrack, isBetweenWhatWasTold)
{
  OdometryTrack track;
  EXPECT_FALSE(track.at(1, kPatience));
  track.add(1, {0, 0, 3.1});
  track.add(2, {4, -2, -3.1});
  const auto between = track.at(1.25, kPatience);
  ASSERT_TRUE(between.has_value());
  EXPECT_DOUBLE_EQ(between->x, 1);
  EXPECT_DOUBLE_EQ(between->y, -0.5);
  EXPECT_NEAR(between->phi, 3.1 + 0.25 * (2 * M_PI - 6.2), 1e-12) << "the short way round";
  EXPECT_DOUBLE_EQ(track.at(1, kPatience)->x, 0);
  EXPECT_DOUBLE_EQ(track.at(2.1, kPatience)->x, 4);
  EXPECT_FALSE(track.at(2.3, kPatience)) << "nothing was told for too long";
  EXPECT_FALSE(track.at(0.9, kPatience)) << "before all that was told";
}

TEST(OdometryTrack, forgets)
{
  OdometryTrack track;
  for (int k = 0; k <= 100; ++k) track.add(k, {0.1 * k, 0, 0});
  EXPECT_FALSE(track.at(50, kPatience));
  EXPECT_NEAR(track.at(95.5, kPatience)->x, 9.55, 1e-12);
  track.add(3, {7, 0, 0});  // time went back
  EXPECT_FALSE(track.at(95.5, kPatience));
  EXPECT_DOUBLE_EQ(track.at(3, kPatience)->x, 7);
  track.clear();
  EXPECT_FALSE(track.at(3, kPatience));
}

TEST(OdometryTrack, ignoresWhatIsNoPose)
{
  OdometryTrack track;
  track.add(1, {std::numeric_limits<double>::quiet_NaN(), 0, 0});
  EXPECT_FALSE(track.at(1, kPatience));
}
}  // namespace
}  // namespace sigloc::ros1
