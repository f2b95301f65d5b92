// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <vector>

#include "sigloc/config/option_fields.h"
#include "sigloc/features/LaserScan.h"
#include "sigloc/map/DenseField.h"

// What is seen from a pose in a map: how likely points are, and scans that a laser could take.

namespace sigloc
{
/// How a particle filter weighs a pose by points. Units, ranges and meanings are in `visitFields`.
struct PointLikelihoodOptions
{
  double sigma = 0.20;
  double outlier_share = 0.05;
  double exponent = 1.0;
  std::uint32_t max_points = 30;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = PointLikelihoodOptions;
    visit(OptionField{"sigma", &O::sigma, 0.01, 5.0,
                      "[m] standard deviation of a point's distance to the map"});
    visit(OptionField{"outlier_share", &O::outlier_share, 0.0001, 0.9999,
                      "[-] share of points that nothing in the map explains"});
    visit(OptionField{"exponent", &O::exponent, 0.001, 10.0,
                      "[-] tempers the log-likelihood: neighbouring beams are not independent"});
    visit(OptionField{"max_points", &O::max_points, 1U, 100000U,
                      "[-] points used of an observation, evenly chosen"});
  }
};

/// Returns at most max_points of the points, evenly chosen.
std::vector<mrpt::math::TPoint2D> thinned(const std::vector<mrpt::math::TPoint2D>& points,
                                          std::size_t max_points);

/// Returns the log-likelihood (<= 0) of points in the robot frame [m] at a pose. Each point is an
/// independent mixture: a Gaussian of its distance to the nearest wall, and an outlier.
double logLikelihood(const DenseField& field, const std::vector<mrpt::math::TPoint2D>& points,
                     const mrpt::math::TPose2D& map_from_robot,
                     const PointLikelihoodOptions& options = {});

/// A laser, and how what it sees differs from the map. Units, ranges and meanings are in
/// `visitFields`. The shares of clutter and moved objects are means: those of a single scan are
/// exponentially distributed.
struct SimulatedLaserOptions
{
  std::uint32_t beams = 541;
  double first_angle = -2.356;
  double angle_step = 0.008727;
  double max_range = 30;
  double sensor_x = 0;
  double sensor_y = 0;
  double sensor_phi = 0;
  double range_sigma = 0.01;
  double map_sigma = 0.02;
  double clutter_share = 0.02;
  double moved_share = 0.03;
  double lost_share = 0.005;
  double unknown_range = 10.0;
  double thin_share = 0.3;
  double backed_within = 0.3;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = SimulatedLaserOptions;
    visit(OptionField{"beams", &O::beams, 2U, 100000U, "[-] in a scan"});
    visit(OptionField{"first_angle", &O::first_angle, -7.0, 7.0, "[rad] of the first beam"});
    visit(OptionField{"angle_step", &O::angle_step, 1e-5, 1.0, "[rad] between two beams"});
    visit(OptionField{"max_range", &O::max_range, 0.1, 1000.0,
                      "[m] surfaces farther away give no return"});
    visit(OptionField{"sensor_x", &O::sensor_x, -10.0, 10.0, "[m] mounting place"});
    visit(OptionField{"sensor_y", &O::sensor_y, -10.0, 10.0, "[m] mounting place"});
    visit(OptionField{"sensor_phi", &O::sensor_phi, -7.0, 7.0, "[rad] mounting direction"});
    visit(OptionField{"range_sigma", &O::range_sigma, 0.0, 1.0, "[m] of a single range"});
    visit(OptionField{"map_sigma", &O::map_sigma, 0.0, 1.0,
                      "[m] of the map along the beams, common to 0.2 rad of them"});
    visit(OptionField{"clutter_share", &O::clutter_share, 0.0, 0.9,
                      "[-] of the beams that end on an unmapped object"});
    visit(OptionField{"moved_share", &O::moved_share, 0.0, 0.9,
                      "[-] of the beams that meet a mapped object which is gone"});
    visit(OptionField{"lost_share", &O::lost_share, 0.0, 0.9, "[-] of the beams without return"});
    visit(OptionField{"unknown_range", &O::unknown_range, 0.01, 1000.0,
                      "[m] that a beam goes on through unknown space, on average"});
    visit(
        OptionField{"thin_share", &O::thin_share, 0.0, 1.0,
                    "[-] of the directions in which wall cells stop beams that most have passed"});
    visit(OptionField{"backed_within", &O::backed_within, 0.0, 10.0,
                      "[m] a wall with unknown space so near behind it stops every beam"});
  }
};

/// Simulates scans in a map. Keeps a reference to the field, which must outlive it. Const and
/// thread-safe.
class ScanSimulator
{
 public:
  /// Throws std::invalid_argument for options outside their ranges.
  explicit ScanSimulator(const DenseField& field, const SimulatedLaserOptions& options = {});

  /// Returns a scan that the laser could take from a pose; equal seeds give equal scans. Beams that
  /// leave the raster have no return.
  LaserScan scan(const mrpt::math::TPose2D& map_from_robot, std::uint64_t seed) const;

  const SimulatedLaserOptions& options() const { return options_; }

 private:
  const DenseField& field_;
  SimulatedLaserOptions options_;
};
}  // namespace sigloc
