// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/config/option_fields.h"
#include "sigloc/features/Feature.h"
#include "sigloc/features/LaserScan.h"
#include "sigloc/features/ObservedScene.h"

#include <vector>

namespace sigloc
{
/// How features are extracted from a scan. The same values are used for real and simulated scans.
/// Units, ranges and meanings are in `visitFields`. \cite algorithm section 2
struct FeatureExtractorOptions
{
  double min_range = 0.05;
  double break_distance = 0.2;
  double break_factor = 5.0;
  double split_distance = 0.06;
  std::uint32_t min_segment_points = 4;
  double min_segment_length = 0.25;
  double wall_end_jump = 0.4;
  double max_circle_diameter = 1.3;
  double corner_gap = 0.3;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = FeatureExtractorOptions;
    visit(OptionField{"min_range", &O::min_range, 0.0, 10.0, "[m] nearer returns are ignored"});
    visit(OptionField{"break_distance", &O::break_distance, 0.01, 5.0,
                      "[m] smallest gap between neighbouring returns that breaks a cluster"});
    visit(OptionField{"break_factor", &O::break_factor, 1.0, 100.0,
                      "[-] the gap grows as this times range times beam spacing"});
    visit(OptionField{"split_distance", &O::split_distance, 0.005, 1.0,
                      "[m] a cluster splits where a return lies farther off its chord"});
    visit(OptionField{"min_segment_points", &O::min_segment_points, 3U, 1000U,
                      "[-] fewest returns of a segment"});
    visit(OptionField{"min_segment_length", &O::min_segment_length, 0.05, 10.0,
                      "[m] shortest segment"});
    visit(OptionField{"wall_end_jump", &O::wall_end_jump, 0.05, 10.0,
                      "[m] a wall ends for real where the next return is this much farther"});
    visit(OptionField{"max_circle_diameter", &O::max_circle_diameter, 0.05, 10.0,
                      "[m] widest cluster tried as a circle"});
    visit(OptionField{"corner_gap", &O::corner_gap, 0.01, 2.0,
                      "[m] largest distance from a corner's vertex to the ends of its segments"});
  }
};

/// Returns the features and returns of all scans of one step, in the robot frame.
/// Scans may have any beam count, field of view and mounting pose. Invalid, NaN, infinite or
/// out-of-range beams are skipped. Throws std::invalid_argument when sizes disagree or the angle
/// step is not positive. \cite algorithm section 2
ObservedScene observeScene(const std::vector<LaserScan>& scans,
                           const FeatureExtractorOptions& options = {});

/// The same with landmarks that another sensor measured, as features in the robot frame.
inline ObservedScene observeScene(const std::vector<LaserScan>& scans,
                                  const std::vector<Feature>& landmarks,
                                  const FeatureExtractorOptions& options = {})
{
  ObservedScene scene = observeScene(scans, options);
  scene.features.insert(scene.features.end(), landmarks.begin(), landmarks.end());
  return scene;
}
}  // namespace sigloc
