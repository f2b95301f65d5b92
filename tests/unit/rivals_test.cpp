// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/rivals.h"

#include <gtest/gtest.h>

#include "tracking/distinguishing_place.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

/// Two closed rooms of 8 m x 8 m, centred on (5, 5) and (15, 5); the right one has a pillar of
/// 0.4 m at `pillar` from its centre, unless that is (0, 0).
DenseField twoRooms(double pillar_x, double pillar_y)
{
  OccupancyRaster raster;
  raster.frame.resolution = 0.1;
  raster.frame.width = 200;
  raster.frame.height = 100;
  raster.cells.assign(200 * 100, CellState::unknown);
  for (int room = 0; room < 2; ++room)
  {
    for (int iy = 10; iy < 90; ++iy)
    {
      for (int ix = 10; ix < 90; ++ix)
      {
        const bool edge = ix == 10 || ix == 89 || iy == 10 || iy == 89;
        const double x = 0.1 * ix - 5.0;
        const double y = 0.1 * iy - 5.0;
        const bool pillar = room == 1 && (pillar_x != 0 || pillar_y != 0) &&
                            std::abs(x - pillar_x) < 0.2 && std::abs(y - pillar_y) < 0.2;
        raster.cells[static_cast<std::size_t>(iy * 200 + room * 100 + ix)] =
            edge || pillar ? CellState::wall : CellState::free;
      }
    }
  }
  return buildDenseField(raster);
}

std::vector<TrackedHypothesis> inBoth(double heading)
{
  std::vector<TrackedHypothesis> both(2);
  both[0].pose.mean = {5, 5, heading};
  both[0].weight = 0.6;
  both[1].pose.mean = {15, 5, heading};
  both[1].weight = 0.39;
  return both;
}

TEST(Rivals, FindsThePillarThatOnlyOneRoomHas)
{
  const DenseField field = twoRooms(0, 2.4);
  const auto place = distinguishingPlace(field, {5, 5, M_PI / 2}, {15, 5, M_PI / 2});
  ASSERT_TRUE(place.has_value());
  // 2.4 m ahead of a robot that faces along y.
  EXPECT_NEAR(place->x, 2.4, 0.5);
  EXPECT_NEAR(place->y, 0.0, 0.5);
  const auto swapped = distinguishingPlace(field, {15, 5, M_PI / 2}, {5, 5, M_PI / 2});
  ASSERT_TRUE(swapped.has_value());
  EXPECT_EQ(*place, *swapped);
}

TEST(Rivals, EqualRoomsLookTheSame)
{
  const DenseField field = twoRooms(0, 0);
  EXPECT_FALSE(distinguishingPlace(field, {5, 5, 0.3}, {15, 5, 0.3}).has_value());
  EXPECT_EQ(describeRivals(inBoth(0.3), 0.01, &field),
            "2 hypotheses remain; the next, of weight 0.39, is 10.0 m away and the map shows no "
            "difference within 8 m");
}

TEST(Rivals, AreDescribedWithAndWithoutAField)
{
  const DenseField field = twoRooms(0, 2.4);
  const std::string line = describeRivals(inBoth(M_PI / 2), 0.01, &field);
  EXPECT_NE(line.find("m from the robot at"), std::string::npos) << line;
  EXPECT_EQ(describeRivals(inBoth(0), 0.01, nullptr),
            "2 hypotheses remain; the next, of weight 0.39, is 10.0 m away");
}

// A rival of weight 1e-4 is not why: the robot may be outside the map, or the map may be wrong.
TEST(Rivals, SomewhereElseIsNamedWhereItWeighsMore)
{
  std::vector<TrackedHypothesis> two = inBoth(0);
  two[1].weight = 1e-4;
  EXPECT_EQ(describeRivals(two, 0.39, nullptr),
            "2 hypotheses remain, and somewhere else weighs 0.39: what was seen does not prove the "
            "first");
  two.pop_back();
  EXPECT_EQ(
      describeRivals(two, 0.39, nullptr),
      "one hypothesis remains, and somewhere else weighs 0.39: what was seen does not prove it");
}
}  // namespace
}  // namespace sigloc
