// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "matching/keypoints/KeyPairSearch.h"
#include "support/wall_between.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;
using test::wallBetween;

constexpr double kGate = 7.879;

KeyPoint randomKeyPoint(std::mt19937_64& random, double side)
{
  std::uniform_real_distribution<double> share(0, 1);
  KeyPoint point;
  point.kind = static_cast<KeyPointKind>(static_cast<int>(share(random) * 4));
  point.position = {side * share(random), side * share(random)};
  const double sigma = 0.01 + 0.03 * share(random);
  point.covariance = {sigma * sigma, 0, sigma * sigma};
  if (point.kind == KeyPointKind::circle)
  {
    point.radius = 0.1 + share(random);
    point.radius_variance = 4e-4;
    return point;
  }
  point.direction = 2 * M_PI * share(random) - M_PI;
  point.direction_variance = std::pow(0.005 + 0.015 * share(random), 2);
  return point;
}

/// Moves a key point as noise of its own size does.
KeyPoint seenAgain(KeyPoint point, std::mt19937_64& random)
{
  std::normal_distribution<double> noise(0, 1);
  point.position.x += std::sqrt(point.covariance.xx) * noise(random);
  point.position.y += std::sqrt(point.covariance.yy) * noise(random);
  if (point.kind == KeyPointKind::circle) return point;
  point.direction = wrapToPi(point.direction + std::sqrt(point.direction_variance) * noise(random));
  return point;
}

/// The largest of the three differences, as a share of its gate. The deviations of the map count
/// `widened` times, and differences may be off by a `slack` of what the index stores coarsely.
double excess(const KeyPair& seen, const KeyPair& mapped, const MapErrorModel& error,
              double widened, double slack)
{
  const bool first_turns = seen.table / kKeyPointKinds != 3;
  const bool second_turns = seen.table % kKeyPointKinds != 3;
  const auto share =
      [&](double difference, double of_seen, double of_mapped, double most, double quantum)
  {
    const double off = std::max(0.0, std::abs(difference) + slack * quantum);
    return off * off / (kGate * (of_seen + widened * widened * std::min(of_mapped, most)));
  };
  constexpr double kMost = KeyPairIndex::kMostOfOthers;
  const double relative = std::pow(error.relativeSigma(mapped.distance), 2);
  const double first = mapped.first - seen.first;
  const double second = mapped.second - seen.second;
  return std::max(
      {share(mapped.distance - seen.distance, seen.distance_variance,
             mapped.distance_variance + relative, KeyPairIndex::kMostOfDistance, 2e-4),
       share(first_turns ? wrapToPi(first) : first, seen.first_variance,
             mapped.first_variance + (first_turns ? relative / std::pow(mapped.distance, 2) : 0.0),
             kMost, 0.01),
       share(second_turns ? wrapToPi(second) : second, seen.second_variance, mapped.second_variance,
             kMost, 0.01)});
}

bool isPairOf(const KeyPairIndex::Match& match, const KeyPair& mapped)
{
  return std::hypot(match.x - mapped.x, match.y - mapped.y) < 1e-4 &&
         std::abs(wrapToPi(match.bearing - mapped.bearing)) < 1e-3;
}

// The index finds the pairs that trying all of them finds.
TEST(KeyPairIndex, FindsTheBruteForceSet)
{
  constexpr std::uint64_t kSeed = 24;
  std::mt19937_64 random(kSeed);
  std::vector<KeyPoint> points;
  for (int k = 0; k < 250; ++k) points.push_back(randomKeyPoint(random, 25));
  const MapErrorModel error{0.005, 0.0005, 0, 0};
  const KeyPairIndex index(points, error);
  ASSERT_GT(index.range(), 8);
  std::vector<KeyPair> held;
  for (const KeyPoint& a : points)
  {
    for (const KeyPoint& b : points)
    {
      if (&a == &b || b.kind < a.kind) continue;
      const KeyPair pair = keyPair(a, b);
      if (pair.distance >= KeyPairIndex::kMinDistance && pair.distance < index.range())
        held.push_back(pair);
    }
  }
  ASSERT_EQ(held.size(), index.size());
  std::size_t found = 0;
  std::size_t right = 0;
  std::size_t asked = 0;
  for (std::size_t i = 0; i < points.size(); i += 5)
  {
    for (std::size_t j = 0; j < points.size(); j += 4)
    {
      if (i == j || points[j].kind < points[i].kind) continue;
      const KeyPair seen = keyPair(seenAgain(points[i], random), seenAgain(points[j], random));
      if (seen.distance < 0.8 || seen.distance > index.range() - 0.3) continue;
      std::vector<KeyPairIndex::Run> runs;
      std::vector<KeyPairIndex::Match> matches;
      const std::size_t count = index.find(seen, runs);
      for (const auto& run : runs) index.collect(seen, run, matches);
      ASSERT_LE(matches.size(), count);
      ++asked;
      found += matches.size();
      std::size_t explained = 0;
      const KeyPair truth = keyPair(points[i], points[j]);
      for (const KeyPair& mapped : held)
      {
        // Stored deviations are up to a quarter larger, stored values off by half a digit.
        if (mapped.table != seen.table || excess(seen, mapped, error, 1.26, -1) > 1) continue;
        const auto hits = std::count_if(matches.begin(), matches.end(),
                                        [&](const auto& match) { return isPairOf(match, mapped); });
        ASSERT_LE(hits, 1);
        ASSERT_GE(hits, excess(seen, mapped, error, 1, 1) <= 1 ? 1 : 0);
        explained += static_cast<std::size_t>(hits);
        if (mapped.x == truth.x && mapped.bearing == truth.bearing)
          right += static_cast<std::size_t>(hits);
      }
      ASSERT_EQ(explained, matches.size()) << "a match outside of the gates";
    }
  }
  EXPECT_GT(asked, 300U);
  EXPECT_GT(found, asked / 2);
  // Three gates of 99.5 % each.
  EXPECT_GT(static_cast<double>(right), 0.97 * static_cast<double>(asked));
}

TEST(KeyPairIndex, HoldsNothingOfAnEmptyMap)
{
  const KeyPairIndex index({}, {});
  EXPECT_EQ(index.size(), 0U);
  KeyPairSearch search(index, {wallBetween({0, 1}, {2, 1}), wallBetween({2, 1}, {2, -1})});
  EXPECT_TRUE(search.next(100).empty());
  EXPECT_TRUE(search.finished());
}

TEST(KeyPoints, CrossingLiesOnBothLines)
{
  const std::vector<KeyPoint> points =
      observedKeyPoints({wallBetween({-3, 2}, {1, 2}), wallBetween({3, 0}, {3, -4}),
                         wallBetween({0, -3}, {1, -3.2})});
  // The third wall is too far from the first one's end, and crosses the second one.
  const auto at = [&](double x, double y)
  {
    return std::count_if(points.begin(), points.end(),
                         [&](const KeyPoint& point)
                         { return std::hypot(point.position.x - x, point.position.y - y) < 1e-9; });
  };
  EXPECT_EQ(at(3, 2), 1);
  EXPECT_EQ(at(3, -3.6), 1);
  EXPECT_EQ(points.size(), 2U);
}

// The propagated covariance is that of crossings of walls which are moved and turned at random.
TEST(KeyPoints, CrossingHasTheCovarianceOfItsWalls)
{
  constexpr std::uint64_t kSeed = 7;
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> noise(0, 1);
  const std::vector<Feature> walls = {wallBetween({-3, 2}, {1, 2.3}),
                                      wallBetween({2, 1}, {2.5, -3})};
  const std::vector<KeyPoint> points = observedKeyPoints(walls);
  ASSERT_EQ(points.size(), 1U);
  const KeyPoint& crossing = points.front();
  double xx = 0;
  double xy = 0;
  double yy = 0;
  double turns = 0;
  constexpr int kDraws = 4000;
  for (int k = 0; k < kDraws; ++k)
  {
    std::vector<Feature> moved = walls;
    for (Feature& feature : moved)
    {
      // A piece of wall is 8 mm off a straight line besides.
      const double variance =
          feature.direction_variance + 12 * 0.008 * 0.008 / (feature.size * feature.size);
      const TPoint2D normal = directionVector(feature);
      feature.position += normal * (0.01 * noise(random));
      feature.direction += std::sqrt(variance) * noise(random);
    }
    const std::vector<KeyPoint> seen = observedKeyPoints(moved);
    ASSERT_EQ(seen.size(), 1U);
    const TPoint2D off = seen.front().position - crossing.position;
    xx += off.x * off.x / kDraws;
    xy += off.x * off.y / kDraws;
    yy += off.y * off.y / kDraws;
    turns += std::pow(wrapToPi(seen.front().direction - crossing.direction), 2) / kDraws;
  }
  EXPECT_NEAR(xx / crossing.covariance.xx, 1, 0.1);
  EXPECT_NEAR(yy / crossing.covariance.yy, 1, 0.1);
  EXPECT_NEAR(xy, crossing.covariance.xy, 0.1 * std::sqrt(xx * yy));
  EXPECT_NEAR(turns / crossing.direction_variance, 1, 0.1);
}
}  // namespace
}  // namespace sigloc
