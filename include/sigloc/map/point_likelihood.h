// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <vector>

#include "sigloc/config/option_fields.h"
#include "sigloc/map/DenseField.h"

namespace sigloc
{
class NearestFeature;

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

/// The same with the distance to the nearest feature.
double logLikelihood(const NearestFeature& nearest, const std::vector<mrpt::math::TPoint2D>& points,
                     const mrpt::math::TPose2D& map_from_robot,
                     const PointLikelihoodOptions& options = {});
}  // namespace sigloc
