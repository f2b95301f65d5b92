// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "matching/dense/DenseVerifier.h"
#include "sigloc/config/option_fields.h"
#include "sigloc/features/Feature.h"
#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
/// How PoseProposer proposes. Units, ranges and meanings are in `visitFields`.
struct PoseProposerOptions
{
  std::uint32_t budget = 20000;
  std::uint32_t slid_walls = 1;
  std::uint32_t enough = 2000;
  std::uint32_t thorough_budget = 12000;
  std::uint32_t thorough_slid_walls = 3;
  double slide_step = 0.4;
  double overhang = 0.3;
  double length_tolerance = 0.3;
  double pair_tolerance = 0.15;
  double pair_range = 15.0;
  std::uint32_t max_pairs = 3;
  std::uint32_t thorough_pairs = 6;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = PoseProposerOptions;
    visit(OptionField{"budget", &O::budget, 1U, 100000000U,
                      "[-] most proposals of one scene, further ones not counted"});
    visit(OptionField{"slid_walls", &O::slid_walls, 0U, 100U,
                      "[-] observed walls that are slid along the mapped ones at least"});
    visit(OptionField{"enough", &O::enough, 0U, 100000000U,
                      "[-] with fewer proposals another observed wall is slid"});
    visit(OptionField{"thorough_budget", &O::thorough_budget, 1U, 100000000U,
                      "[-] most further proposals where the first explain the scene poorly"});
    visit(OptionField{"thorough_slid_walls", &O::thorough_slid_walls, 0U, 100U,
                      "[-] observed walls that are slid in all where further poses are proposed"});
    visit(OptionField{"slide_step", &O::slide_step, 0.05, 5.0, "[m] step of a slid wall"});
    visit(OptionField{"overhang", &O::overhang, 0.0, 1.0,
                      "[-] share of an observed wall that may lie beyond the mapped one"});
    visit(OptionField{"length_tolerance", &O::length_tolerance, 0.0, 5.0,
                      "[m] by which an observed wall may be longer than the mapped one"});
    visit(OptionField{"pair_tolerance", &O::pair_tolerance, 0.01, 2.0,
                      "[m] gate on the distance of two circles"});
    visit(OptionField{"pair_range", &O::pair_range, 0.5, 100.0,
                      "[m] largest distance of a pair of circles"});
    visit(OptionField{"max_pairs", &O::max_pairs, 0U, 1000U,
                      "[-] observed pairs of circles tried, rarest distance first"});
    visit(OptionField{"thorough_pairs", &O::thorough_pairs, 0U, 1000U,
                      "[-] observed pairs tried in all where further poses are proposed"});
  }
};

/// Mode (e): proposes poses from minimal sets of features, which the dense field then scores. A set
/// is one wall end, one wall slid along the mapped ones, or a rare pair of circles.
/// Const and thread-safe. \cite algorithm section 4 (e), eq. (4.8), (4.9)
class PoseProposer
{
 public:
  /// Copies what it needs of the map. Throws std::invalid_argument for options outside their
  /// ranges.
  explicit PoseProposer(const FeatureMap& map, const PoseProposerOptions& options = {});

  /// Returns the poses proposed for observed features: wall ends first, then circles, then slid
  /// walls, at most `budget` poses. They are enough for nearly every scene.
  std::vector<PoseProposal> propose(const std::vector<Feature>& observed) const;

  /// Returns further poses for a scene that the first ones explain poorly, at most
  /// `thorough_budget` of them.
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

  void proposeWallEnds(const std::vector<Feature>& observed, std::vector<PoseProposal>& out) const;
  std::vector<const Feature*> wallsToSlide(const std::vector<Feature>& observed) const;
  void slide(const Feature& wall, std::size_t most, std::vector<PoseProposal>& out) const;
  void proposeCirclePairs(const std::vector<Feature>& observed, std::size_t first, std::size_t last,
                          std::vector<PoseProposal>& out) const;

  PoseProposerOptions options_;
  std::array<std::vector<MappedEnd>, 2> wall_ends_;  // by side, longest wall first
  std::vector<MappedWall> walls_;  // longest first
  std::vector<CirclePair> pairs_;  // by distance
};
}  // namespace sigloc
