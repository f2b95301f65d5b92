// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map_alignment.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "FreeSpaceGrid.h"
#include "sigloc/features/observe_scans.h"
#include "sigloc/map/sensor_model.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "wall_points.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr std::uint32_t kBeams = 360;
constexpr double kRange = 30;  // [m]
constexpr std::size_t kMostPoints = 5000;  // of walls, for the refinement
constexpr std::size_t kMostRefined = 30;
constexpr double kSameDistance = 1.0;  // [m] between poses that agree, in the middle of b
constexpr double kSameAngle = 0.12;  // [rad]
constexpr double kLeastWeight = 0.01;
constexpr double kLeastExplained = 0.3;  // of a pose that is possible

/// A laser that sees b as it is mapped, all around.
SimulatedLaserOptions exactLaser()
{
  SimulatedLaserOptions laser;
  laser.beams = kBeams;
  laser.first_angle = -M_PI;
  laser.angle_step = 2 * M_PI / kBeams;
  laser.max_range = kRange;
  laser.range_sigma = laser.map_sigma = 0;
  laser.clutter_share = laser.moved_share = laser.lost_share = 0;
  laser.thin_share = laser.backed_within = 0;
  laser.unknown_range = 1000;
  return laser;
}

bool agree(const TPose2D& p, const TPose2D& q, const TPoint2D& middle_of_b)
{
  const TPoint2D off = p.composePoint(middle_of_b) - q.composePoint(middle_of_b);
  return off.norm() < kSameDistance && std::abs(mrpt::math::wrapToPi(p.phi - q.phi)) < kSameAngle;
}

TPoint2D middleOf(const DenseField& field)
{
  const RasterFrame& frame = field.frame;
  return frame.origin + TPoint2D(frame.width, frame.height) * (0.5 * frame.resolution);
}

/// Adds a pose to the one it agrees with, or as a new one.
void gather(std::vector<MapPose>& poses, const MapPose& pose, const TPoint2D& middle_of_b)
{
  for (MapPose& known : poses)
  {
    if (!agree(known.a_from_b.mean, pose.a_from_b.mean, middle_of_b)) continue;
    if (pose.explained > known.explained) known.a_from_b = pose.a_from_b;
    known.overlap = pose.explained > known.explained ? pose.overlap : known.overlap;
    known.explained = std::max(known.explained, pose.explained);
    known.weight += pose.weight;
    return;
  }
  poses.push_back(pose);
}

void sortByWeight(std::vector<MapPose>& poses)
{
  std::stable_sort(poses.begin(), poses.end(),
                   [](const MapPose& x, const MapPose& y) { return x.weight > y.weight; });
}

/// Where b would be in a, by the views from places of b.
std::vector<MapPose> proposePoses(const SignatureMatcher& a, const DenseField& b,
                                  std::size_t places,
                                  const std::function<void(double share)>& progress)
{
  const ScanSimulator simulator(b, exactLaser());
  const std::vector<TPoint2D> viewed = FreeSpaceGrid(b).spreadPlaces(places);
  std::vector<MapPose> poses;
  for (std::size_t k = 0; k < viewed.size(); ++k)
  {
    const TPose2D b_from_robot(viewed[k].x, viewed[k].y, 0);
    const auto result = a.localize(observeScene({simulator.scan(b_from_robot, k)}));
    for (const Candidate& candidate : result.candidates)
    {
      MapPose pose;
      pose.a_from_b.mean = candidate.pose.mean + (TPose2D(0, 0, 0) - b_from_robot);
      pose.weight = candidate.probability / static_cast<double>(viewed.size());
      gather(poses, pose, middleOf(b));
    }
    if (progress) progress(static_cast<double>(k + 1) / static_cast<double>(viewed.size()));
  }
  sortByWeight(poses);
  if (poses.size() > kMostRefined) poses.resize(kMostRefined);
  return poses;
}
}  // namespace

std::vector<MapPose> alignMaps(const std::shared_ptr<const FeatureMap>& a, const FeatureMap& b,
                               const AlignmentOptions& options,
                               const std::function<void(double share)>& progress)
{
  for (const FeatureMap* map : {a.get(), &b})
  {
    if (!map->field())
      throw std::invalid_argument("a map of landmarks alone cannot be aligned: it has no walls");
  }
  const SignatureMatcher matcher(a);
  const std::vector<TPoint2D> points = wallPoints(*b.field(), kMostPoints);
  std::vector<MapPose> refined;
  for (MapPose pose : proposePoses(matcher, *b.field(), options.places, progress))
  {
    refinePose(*a->field(), points, pose);
    pose.a_from_b = withCommonError(pose.a_from_b, a->error());
    if (pose.explained >= kLeastExplained) gather(refined, pose, middleOf(*b.field()));
  }
  sortByWeight(refined);
  while (!refined.empty() && refined.back().weight < kLeastWeight) refined.pop_back();
  return refined;
}
}  // namespace sigloc
