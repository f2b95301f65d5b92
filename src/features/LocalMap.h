// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "sigloc/config/option_fields.h"
#include "sigloc/features/Feature.h"
#include "sigloc/geometry/GaussianPose.h"

namespace sigloc
{
/// How a local map is gathered. Units, ranges and meanings are in `visitFields`.
struct LocalMapOptions
{
  double gate_probability = 0.999;
  double max_distance = 60.0;
  double place_sigma = 0.02;
  double radius_share = 0.3;
  std::uint32_t forget_after = 5;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = LocalMapOptions;
    visit(OptionField{"gate_probability", &O::gate_probability, 0.5, 0.9999999,
                      "[-] share of repeated sightings that are recognised as such"});
    visit(OptionField{"max_distance", &O::max_distance, 1.0, 1000.0,
                      "[m] features farther behind the robot are forgotten"});
    visit(OptionField{"place_sigma", &O::place_sigma, 0.0, 1.0,
                      "[m] how far a place wanders with the view, beyond its covariance"});
    visit(OptionField{"radius_share", &O::radius_share, 0.0, 1.0,
                      "[-] a circle's centre wanders by this share of its radius besides"});
    visit(OptionField{"forget_after", &O::forget_after, 1U, 1000U,
                      "[-] steps after which a place seen only once is forgotten"});
  }
};

/// Features gathered over a short stretch of odometry, for when one scan has too few.
///
/// Everything is in the current robot frame. Each step moves the features by the odometry,
/// corrected by those seen again. What the correction leaves uncertain widens their covariances, so
/// that they grow with the age of a feature. Sightings are associated with each other by place
/// alone. Places (points, circles, corners, wall ends) are gathered. Segments are those of the last
/// step, because pieces of a wall have no place of their own.
class LocalMap
{
 public:
  explicit LocalMap(const LocalMapOptions& options = {});

  /// Moves the features by `motion` (previous_from_current), then adds the observed ones, robot
  /// frame.
  void add(const MotionIncrement& motion, const std::vector<Feature>& observed);

  /// Returns the features seen at least `min_sightings` times, in the current robot frame.
  std::vector<Feature> features(std::uint32_t min_sightings = 1) const;

  double travelled() const { return travelled_; }  ///< [m]
  std::size_t steps() const { return steps_; }

 private:
  struct Match
  {
    std::size_t gathered;
    std::size_t observed;
    double squared_distance;
  };
  Feature widened(const Feature& seen) const;
  void forget();
  std::vector<Match> associate(const MotionIncrement& motion,
                               const std::vector<Feature>& observed) const;
  MotionIncrement corrected(const MotionIncrement& motion, const std::vector<Feature>& observed,
                            const std::vector<Match>& matches) const;

  LocalMapOptions options_;
  double gate_;
  std::vector<Feature> places_;
  std::vector<std::size_t> born_;  ///< step in which each place was first seen
  std::vector<Feature> segments_;
  double travelled_ = 0;
  std::size_t steps_ = 0;
};
}  // namespace sigloc
