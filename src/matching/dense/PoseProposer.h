// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "matching/dense/DenseVerifier.h"
#include "sigloc/features/Feature.h"
#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
/// Mode (e): proposes poses from minimal sets of features, which the dense field then scores. A set
/// is one wall end, one wall slid along the mapped ones, or a rare pair of circles.
/// Const and thread-safe. \cite algorithm section 4 (e), eq. (4.8), (4.9)
class PoseProposer
{
 public:
  /// Copies what it needs of the map.
  explicit PoseProposer(const FeatureMap& map);

  /// Returns the poses proposed for observed features: wall ends first, then circles, then slid
  /// walls. They are enough for nearly every scene. None is cut: in a large map they are very many.
  std::vector<PoseProposal> propose(const std::vector<Feature>& observed) const;

  /// Returns further poses for a scene that the first ones explain poorly.
  std::vector<PoseProposal> proposeFurther(const std::vector<Feature>& observed) const;

 private:
  struct MappedEnd
  {
    mrpt::math::TPoint2D position;  // [m]
    double length;  // [m] of its wall
    double direction;  // [rad] of its wall
    double c, s;  // cosine and sine of the direction
  };
  struct MappedWall
  {
    double direction;  // [rad] of the normal
    double c, s;  // cosine and sine of the direction
    mrpt::math::TPoint2D start;  // [m] of the linked wall
    double length;  // [m]
  };
  struct CirclePair
  {
    double distance;  // [m]
    std::uint32_t from, to;  // indices of the map features
    mrpt::math::TPoint2D middle;  // [m]
    double from_radius, to_radius;  // [m]
    double bearing;  // [rad] of `to` from `from`
    double c, s;  // cosine and sine of the bearing
  };

  struct ObservedPair;

  void indexWallEnds(const std::vector<Feature>& features);
  void indexWalls(const FeatureMap& map);
  void indexCirclePairs(const std::vector<Feature>& features);
  std::size_t mostByWallEnds(const std::vector<Feature>& observed) const;
  void proposeWallEnds(const std::vector<Feature>& observed, std::vector<PoseProposal>& out) const;
  void slide(const Feature& wall, std::vector<PoseProposal>& out) const;
  std::vector<ObservedPair> rankedCirclePairs(const std::vector<Feature>& observed) const;
  void proposeCirclePairs(const std::vector<Feature>& observed, std::size_t first, std::size_t last,
                          std::vector<PoseProposal>& out) const;

  std::array<std::vector<MappedEnd>, 2> wall_ends_;  // by side, and by place
  std::vector<MappedWall> walls_;  // by place
  std::size_t most_slid_ = 0;  // proposals by one observed wall, for memory allocated at once
  std::vector<CirclePair> pairs_;  // by distance
};
}  // namespace sigloc
