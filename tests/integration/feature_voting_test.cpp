// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/features/FeatureVoting.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <Eigen/Dense>

#include <cmath>
#include <set>

#include "eval/worlds/Random.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

Feature makeFeature(FeatureType type, double x, double y, double direction = 0, double size = 0)
{
  Feature feature;
  feature.type = type;
  feature.position = {x, y};
  feature.direction = direction;
  feature.size = size;
  feature.position_covariance.setDiagonal(1e-4);
  return feature;
}

// Points and corners strewn over 20 m x 15 m.
std::vector<Feature> strewnFeatures(std::uint64_t seed)
{
  Random random(seed);
  std::vector<Feature> features;
  for (int i = 0; i < 40; ++i)
  {
    const bool corner = i % 4 == 0;
    features.push_back(makeFeature(corner ? FeatureType::corner : FeatureType::point,
                                   random.uniform(0, 20), random.uniform(0, 15),
                                   corner ? random.uniform(-M_PI, M_PI) : 0, corner ? 1.5 : 0));
  }
  return features;
}

std::vector<Feature> seenFrom(const std::vector<Feature>& features, const TPose2D& pose,
                              double range)
{
  std::vector<Feature> seen;
  const TPose2D robot_from_map = TPose2D(0, 0, 0) - pose;
  for (const Feature& feature : features)
  {
    const Feature observed = transformed(robot_from_map, feature);
    if (std::hypot(observed.position.x, observed.position.y) < range) seen.push_back(observed);
  }
  return seen;
}

// The votes for one position and heading by their definition, cell by cell around it.
double votesByDefinition(const std::vector<Feature>& mapped, const std::vector<Feature>& observed,
                         const FeatureVotingOptions& options, const TPose2D& pose)
{
  double low_x = 1e9;
  double low_y = 1e9;
  for (const Feature& f : mapped)
  {
    low_x = std::min(low_x, f.position.x);
    low_y = std::min(low_y, f.position.y);
  }
  const auto cell_of = [&](double x, double low)
  { return static_cast<int>(std::floor((x - low) / options.cell)); };
  std::set<std::tuple<std::size_t, int, int>> votes;
  for (std::size_t i = 0; i < observed.size(); ++i)
  {
    for (const Feature& f : mapped)
    {
      if (f.type != observed[i].type) continue;
      double heading = pose.phi;
      if (f.type == FeatureType::corner)
      {
        heading = f.direction - observed[i].direction;
        const double off = std::abs(mrpt::math::angDistance(heading, pose.phi));
        if (off >= 2 * M_PI / options.headings) continue;
      }
      const auto& p = observed[i].position;
      const double x = f.position.x - std::cos(heading) * p.x + std::sin(heading) * p.y;
      const double y = f.position.y - std::sin(heading) * p.x - std::cos(heading) * p.y;
      const int column = cell_of(x, low_x);
      const int row = cell_of(y, low_y);
      if (std::abs(column - cell_of(pose.x, low_x)) > 1) continue;
      if (std::abs(row - cell_of(pose.y, low_y)) > 1) continue;
      votes.emplace(i, column, row);
    }
  }
  return static_cast<double>(votes.size());
}

TEST(FeatureVoting, CountsTheVotesThatTheDefinitionGives)
{
  const std::vector<Feature> mapped = strewnFeatures(11);
  const FeatureMap map(mapped);
  const FeatureVotingOptions options;
  const FeatureVoting voting(map, options);
  const TPose2D truth(10.3, 7.1, 0.7);
  const std::vector<Feature> observed = seenFrom(mapped, truth, 6);
  const auto result = voting.vote(observed);
  ASSERT_EQ(result.candidates.size(), options.max_candidates);
  for (const Candidate& candidate : result.candidates)
  {
    EXPECT_EQ(candidate.score, votesByDefinition(mapped, observed, options, candidate.pose.mean));
  }
}

TEST(FeatureVoting, FindsPlacesAmongPointsAndCorners)
{
  const std::vector<Feature> mapped = strewnFeatures(12);
  const FeatureMap map(mapped);
  const FeatureVoting voting(map, {});
  Random random(12, 1);
  std::size_t right = 0;
  constexpr std::size_t kPlaces = 20;
  for (std::size_t i = 0; i < kPlaces; ++i)
  {
    const TPose2D truth(random.uniform(4, 16), random.uniform(4, 11), random.uniform(-M_PI, M_PI));
    const auto result = voting.vote(seenFrom(mapped, truth, 6));
    ASSERT_FALSE(result.candidates.empty());
    const TPose2D& pose = result.candidates.front().pose.mean;
    if (std::hypot(pose.x - truth.x, pose.y - truth.y) < 0.5) ++right;
  }
  EXPECT_GE(right, kPlaces - 2);
}

TEST(FeatureVoting, SlidesWallsAlongWalls)
{
  // A long wall and a short one at right angles: together they fix the position.
  const std::vector<Feature> mapped = {makeFeature(FeatureType::segment, 5, 0, M_PI / 2, 10),
                                       makeFeature(FeatureType::segment, 0, 1, 0, 2)};
  const FeatureMap map(mapped);
  const FeatureVoting voting(map, {});
  std::vector<Feature> observed = seenFrom(mapped, {3, 0.8, 0.3}, 100);
  observed[0].size = 4;  // half of the long wall is hidden
  const auto result = voting.vote(observed);
  ASSERT_FALSE(result.candidates.empty());
  EXPECT_GT(result.votes, 2U);
}

TEST(FeatureVoting, AnEmptyMapIsRefused)
{
  const FeatureMap map;
  EXPECT_THROW(FeatureVoting(map, {}), std::invalid_argument);
}
}  // namespace
}  // namespace sigloc
