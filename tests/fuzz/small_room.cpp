// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/small_room.h"

#include <algorithm>
#include <cmath>

#include "fuzz/targets.h"
#include "map/RayCaster.h"
#include "sigloc/map/map_building.h"

namespace sigloc::fuzz
{
namespace
{
constexpr std::uint32_t kWidth = 84;
constexpr std::uint32_t kHeight = 64;
constexpr double kFar = 12.0;  // [m], of the laser

OccupancyRaster rasterOfRoom()
{
  OccupancyRaster raster;
  raster.frame = {{-4.2, -3.2}, 0.1, kWidth, kHeight};
  for (std::uint32_t y = 0; y < kHeight; ++y)
  {
    for (std::uint32_t x = 0; x < kWidth; ++x)
    {
      const bool outside = x < 2 || y < 2 || x >= kWidth - 2 || y >= kHeight - 2;
      const bool inner = y == 40 && x > 30;
      const bool pillar = (x / 3 == 6 && y / 3 == 5) || (x / 3 == 19 && y / 3 == 8);
      raster.cells.push_back(outside || inner || pillar ? CellState::wall : CellState::free);
    }
  }
  return raster;
}

void requireLawsOfPose(const GaussianPose& pose)
{
  require(std::isfinite(pose.mean.x) && std::isfinite(pose.mean.y), "a place that is no number");
  require(std::abs(pose.mean.phi) <= M_PI + 1e-9, "a heading beyond half a turn");
  for (int row = 0; row < 3; ++row)
  {
    require(pose.covariance(row, row) >= 0, "a negative variance");
    for (int column = 0; column < 3; ++column)
    {
      require(std::isfinite(pose.covariance(row, column)), "a covariance that is no number");
      const double both = pose.covariance(row, row) * pose.covariance(column, column);
      require(std::pow(pose.covariance(row, column), 2) <= both * (1 + 1e-6) + 1e-12,
              "a correlation above one");
    }
  }
}

bool isShare(double value)
{
  return value >= 0 && value <= 1 + 1e-12;
}
}  // namespace

std::shared_ptr<const FeatureMap> smallRoom()
{
  static const auto map = std::make_shared<const FeatureMap>(buildMapFromRaster(rasterOfRoom()));
  return map;
}

std::shared_ptr<const FeatureMap> landmarksOfRoom()
{
  static const auto map = std::make_shared<const FeatureMap>(smallRoom()->features());
  return map;
}

std::shared_ptr<const SignatureMatcher> matcherIn(const std::shared_ptr<const FeatureMap>& map)
{
  return std::make_shared<const SignatureMatcher>(map);
}

LaserScan scanInRoom(const mrpt::math::TPose2D& map_from_robot)
{
  LaserScan scan;
  scan.first_angle = -M_PI;
  scan.angle_step = 2 * M_PI / kBeams;
  scan.max_range = kFar;
  const RayCaster rays(*smallRoom()->field());
  for (std::size_t beam = 0; beam < kBeams; ++beam)
  {
    const double angle =
        map_from_robot.phi + scan.first_angle + static_cast<double>(beam) * scan.angle_step;
    const auto range = rays.cast({map_from_robot.x, map_from_robot.y}, angle, kFar);
    scan.ranges.push_back(static_cast<float>(range.value_or(0)));
    scan.valid.push_back(range ? 1 : 0);
  }
  return scan;
}

void requireLaws(const Belief& belief, double sure)
{
  double sum = belief.elsewhere;
  for (const TrackedHypothesis& hypothesis : belief.hypotheses)
  {
    requireLawsOfPose(hypothesis.pose);
    require(isShare(hypothesis.weight), "a weight outside [0, 1]");
    require(hypothesis.weight <= belief.hypotheses.front().weight, "the first is not the best");
    sum += hypothesis.weight;
  }
  require(std::abs(sum - 1) < 1e-6, "weights that do not add up to one");
  require(isShare(belief.elsewhere), "elsewhere outside [0, 1]");
  require(isShare(belief.probability), "a probability outside [0, 1]");
  require(isShare(belief.reliability), "a reliability outside [0, 1]");
  if (belief.verdict == Verdict::localized)
  {
    require(!belief.hypotheses.empty(), "localized at no pose");
    require(belief.probability >= sure - 1e-12, "localized, but not sure");
  }
}

void requireLaws(const RelocationResult& result)
{
  double sum = result.elsewhere;
  for (const Candidate& candidate : result.candidates)
  {
    requireLawsOfPose(candidate.pose);
    for (const double share :
         {candidate.probability, candidate.explained, candidate.through_wall, candidate.in_free})
    {
      require(isShare(share), "a share outside [0, 1]");
    }
    require(std::isfinite(candidate.score), "a score that is no number");
    sum += candidate.probability;
  }
  require(std::abs(sum - 1) < 1e-6, "probabilities that do not add up to one");
  require(isShare(result.elsewhere) && isShare(result.probability), "a probability off [0, 1]");
  if (result.verdict == Verdict::localized)
  {
    require(!result.candidates.empty(), "localized at no pose");
    require(result.probability >= kLocalizedProbability - 1e-12, "localized, but not sure");
  }
}
}  // namespace sigloc::fuzz
