// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>

#include "eval/worlds/robot_simulation.h"
#include "eval/worlds/world_generators.h"
#include "sigloc/matching/SignatureMatcher.h"

namespace sigloc::test
{
/// A simulated world with the map of a mapping run and query poses.
class MappedWorld
{
 public:
  explicit MappedWorld(World world, std::uint64_t seed, double spacing = 1.2)
      : world_(std::move(world)), space_(world_, kRobotClearance), simulator_(world_, laser())
  {
    map_ = std::make_shared<FeatureMap>(
        buildMapFromScans(simulateMapping(world_, spacing, kRobotClearance, laser(), seed)));
    matcher_ = std::make_shared<SignatureMatcher>(map_);
  }

  static LaserOptions laser()
  {
    LaserOptions options;
    options.beams = 181;
    options.fov_deg = 270;
    return options;
  }

  const World& world() const { return world_; }
  const std::shared_ptr<const FeatureMap>& map() const { return map_; }
  const std::shared_ptr<const SignatureMatcher>& matcher() const { return matcher_; }
  const FreeSpace& space() const { return space_; }

  mrpt::math::TPose2D randomPose(Random& random) const
  {
    const mrpt::math::TPoint2D p = space_.randomPlace(random);
    return {p.x, p.y, random.uniform(-M_PI, M_PI)};
  }
  LaserScan scan(const mrpt::math::TPose2D& pose, Random& random) const
  {
    return simulator_.scan(pose, random);
  }
  ObservedScene sceneAt(const mrpt::math::TPose2D& pose, Random& random) const
  {
    return observeScene({simulator_.scan(pose, random)});
  }

 private:
  World world_;
  FreeSpace space_;
  LaserSimulator simulator_;
  std::shared_ptr<const FeatureMap> map_;
  std::shared_ptr<const SignatureMatcher> matcher_;
};

inline World officeWorld(std::uint64_t seed)
{
  WorldOptions options;
  options.width = 20;
  options.height = 12;
  return makeWorld(WorldKind::office, options, seed);
}

/// The office of several laws, built once.
inline constexpr std::uint64_t kLawOfficeSeed = 3;
inline const MappedWorld& lawOffice()
{
  static const MappedWorld world(officeWorld(kLawOfficeSeed), kLawOfficeSeed);
  return world;
}

/// Right: within 0.5 m and 10 degrees of the truth.
inline bool isRight(const mrpt::math::TPose2D& pose, const mrpt::math::TPose2D& truth)
{
  return sigloc::isRight(errorBetween(pose, truth));
}
}  // namespace sigloc::test
