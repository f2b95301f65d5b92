// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/round_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/wall_between.h"

namespace sigloc
{
namespace
{
using test::wallBetween;

/// Chords of the circle of a radius [m] around (1, 2), each over `step` [rad], as seen from inside,
/// where `step` is negative from outside.
std::vector<Feature> chords(double radius, const std::vector<double>& angles, double step)
{
  std::vector<Feature> walls;
  const auto at = [&](double angle) -> mrpt::math::TPoint2D {
    return {1 + radius * std::cos(angle), 2 + radius * std::sin(angle)};
  };
  for (const double angle : angles) walls.push_back(wallBetween(at(angle), at(angle + step)));
  return walls;
}

std::ptrdiff_t countRound(const std::vector<Feature>& features)
{
  const std::vector<bool> on = onRoundWalls(features);
  EXPECT_EQ(on.size(), features.size());
  return std::count(on.begin(), on.end(), true);
}

TEST(RoundWalls, PiecesFarApartAreOneWall)
{
  EXPECT_EQ(countRound(chords(2.5, {0, 0.4, 2, 3, 4.5}, 0.4)), 5);
  EXPECT_EQ(countRound(chords(6, {0, 0.25, 0.9}, -0.25)), 3);
}

TEST(RoundWalls, TwoPiecesShowNoCircle)
{
  EXPECT_EQ(countRound({}), 0);
  EXPECT_EQ(countRound(chords(2.5, {0, 0.4}, 0.4)), 0);
}

// The bisectors of a regular room meet in its middle, too.
TEST(RoundWalls, ARegularRoomIsNotRound)
{
  EXPECT_EQ(countRound(chords(3, {0, M_PI / 2, M_PI, 3 * M_PI / 2}, M_PI / 2)), 0);
  EXPECT_EQ(countRound(chords(3, {0, M_PI / 3, 2 * M_PI / 3, M_PI, 4 * M_PI / 3}, M_PI / 3)), 0);
}

// Both walls of a curved corridor, and a straight wall between them in the list.
TEST(RoundWalls, EachCircleIsFound)
{
  std::vector<Feature> features = chords(4, {0, 0.3, 0.6}, 0.3);
  features.push_back(wallBetween({0, 0}, {1, 0.2}));
  const std::vector<Feature> inner = chords(2.5, {0.6, 0.2, -0.2}, -0.4);
  features.insert(features.end(), inner.begin(), inner.end());
  EXPECT_EQ(countRound(features), 6);
  EXPECT_FALSE(onRoundWalls(features)[3]);
}
}  // namespace
}  // namespace sigloc
