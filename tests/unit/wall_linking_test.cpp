// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/wall_linking.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "map/building/wall_end_lengths.h"
#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;

Feature wallPiece(const TPoint2D& middle, double direction, double size)
{
  Feature wall;
  wall.type = FeatureType::segment;
  wall.position = middle;
  wall.direction = direction;
  wall.size = size;
  return wall;
}

/// Wall pieces near a few lines along both axes, with gaps of all sizes.
std::vector<Feature> randomWalls(std::size_t count, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0, 40);
  std::uniform_real_distribution<double> size(0.3, 5);
  std::normal_distribution<double> noise(0, 0.04);
  std::vector<Feature> walls;
  for (std::size_t k = 0; k < count; ++k)
  {
    const double across = 5 * std::floor(place(random) / 5) + noise(random);
    const bool along_x = random() % 2 == 0;
    const TPoint2D middle =
        along_x ? TPoint2D(place(random), across) : TPoint2D(across, place(random));
    const double direction = (along_x ? 0.5 : 0.0) * M_PI + (random() % 2 == 0 ? M_PI : 0);
    walls.push_back(
        wallPiece(middle, mrpt::math::wrapToPi(direction + noise(random)), size(random)));
  }
  return walls;
}

std::set<std::vector<std::uint32_t>> membersOf(const std::vector<WallLine>& lines)
{
  std::set<std::vector<std::uint32_t>> sets;
  for (const WallLine& line : lines)
  {
    std::vector<std::uint32_t> members = line.members;
    std::sort(members.begin(), members.end());
    sets.insert(members);
  }
  return sets;
}

/// The definition. The longest fragment left takes what lies on its line and can be reached across
/// openings of up to 4 m. It goes through all fragments as long as any is added.
std::set<std::vector<std::uint32_t>> linkedByDefinition(const std::vector<Feature>& walls)
{
  std::vector<std::uint32_t> order(walls.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return walls[a].size > walls[b].size; });
  std::vector<bool> linked(walls.size(), false);
  std::set<std::vector<std::uint32_t>> sets;
  for (const std::uint32_t longest : order)
  {
    if (linked[longest]) continue;
    const Feature& wall = walls[longest];
    const auto coordinates = [&](const TPoint2D& p)
    {
      const TPoint2D d = p - wall.position;
      const TPoint2D t = tangentVector(wall);
      const TPoint2D n = directionVector(wall);
      return TPoint2D(t.x * d.x + t.y * d.y, n.x * d.x + n.y * d.y);
    };
    std::vector<std::uint32_t> members{longest};
    linked[longest] = true;
    double low = coordinates(segmentStart(wall)).x;
    double high = coordinates(segmentEnd(wall)).x;
    for (bool grew = true; grew;)
    {
      grew = false;
      for (std::uint32_t k = 0; k < walls.size(); ++k)
      {
        const TPoint2D start = coordinates(segmentStart(walls[k]));
        const TPoint2D end = coordinates(segmentEnd(walls[k]));
        const double turn = mrpt::math::wrapToPi(walls[k].direction - wall.direction);
        if (linked[k] || std::abs(turn) > 0.08 || std::abs(start.y) >= 0.15 ||
            std::abs(end.y) >= 0.15 || start.x > high + 4 || end.x < low - 4)
        {
          continue;
        }
        linked[k] = true;
        members.push_back(k);
        low = std::min(low, start.x);
        high = std::max(high, end.x);
        grew = true;
      }
    }
    std::sort(members.begin(), members.end());
    sets.insert(members);
  }
  return sets;
}

TEST(LinkWalls, FollowsItsDefinition)
{
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U})
  {
    const std::vector<Feature> walls = randomWalls(150, seed);
    const auto linked = membersOf(linkWalls(walls));
    EXPECT_EQ(linked, linkedByDefinition(walls)) << seed;
    EXPECT_LT(linked.size(), 130U) << "some must be linked";
    EXPECT_GT(linked.size(), 20U) << "not all are one";
  }
}

TEST(LinkWalls, IsLocal)
{
  const std::vector<Feature> walls = randomWalls(150, 6);
  std::vector<Feature> with_copy = walls;
  for (Feature copy : walls)
  {
    copy.position.x += 100;  // on the lines of the first
    copy.size += 1;  // so that its fragments are taken first
    with_copy.push_back(copy);
  }
  std::set<std::vector<std::uint32_t>> of_the_first;
  for (const auto& members : membersOf(linkWalls(with_copy)))
  {
    if (members.front() < walls.size()) of_the_first.insert(members);
  }
  EXPECT_EQ(of_the_first, membersOf(linkWalls(walls)));
}

TEST(LinkWalls, MembersAreInOrderAlongTheWall)
{
  for (const WallLine& line : linkWalls(randomWalls(150, 7)))
  {
    for (std::size_t i = 1; i < line.members.size(); ++i)
    {
      EXPECT_NE(line.members[i - 1], line.members[i]);
    }
  }
  std::vector<Feature> walls;
  for (const double x : {6.0, 0.0, 3.0}) walls.push_back(wallPiece({x, 0}, M_PI / 2, 1 + 0.1 * x));
  const auto lines = linkWalls(walls);
  ASSERT_EQ(lines.size(), 1U);
  const bool rising = lines.front().members == std::vector<std::uint32_t>{1, 2, 0};
  const bool falling = lines.front().members == std::vector<std::uint32_t>{0, 2, 1};
  EXPECT_TRUE(rising || falling);
}

/// A wall end at the origin with a wall from it along x, facing up.
Feature endAtOrigin()
{
  Feature end;
  end.type = FeatureType::wall_end;
  end.side = WallSide::start;
  end.direction = 0;
  end.size = 0.5;
  return end;
}

TEST(WallEndLengths, AreThoseOfTheLinkedWallBehind)
{
  std::vector<Feature> features{endAtOrigin(), wallPiece({1, 0.02}, M_PI / 2, 2),
                                wallPiece({5, 0}, M_PI / 2, 3)};
  setWallEndLengths(features);
  EXPECT_NEAR(features.front().size, 6.5, 0.05);
}

TEST(WallEndLengths, DoNotReachToAnotherWallOnTheSameLine)
{
  std::vector<Feature> features{endAtOrigin(), wallPiece({1, 0}, M_PI / 2, 2),
                                wallPiece({30, 0}, M_PI / 2, 10)};
  setWallEndLengths(features);
  EXPECT_NEAR(features.front().size, 2, 1e-6);
}

TEST(WallEndLengths, IgnoreTheOtherFaceAndKeepWhatWasSeen)
{
  std::vector<Feature> features{endAtOrigin(), wallPiece({4, 0}, -M_PI / 2, 8)};
  setWallEndLengths(features);
  EXPECT_DOUBLE_EQ(features.front().size, 0.5);
}
}  // namespace
}  // namespace sigloc
