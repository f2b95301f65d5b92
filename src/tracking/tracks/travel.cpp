// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/travel.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

namespace sigloc
{
using mrpt::math::TPose2D;

double travelOf(const TPose2D& motion, const TrackerOptions& options)
{
  return std::hypot(motion.x, motion.y) +
         std::abs(motion.phi) * options.evidence_distance / options.evidence_turn;
}

double travelBetween(const TPose2D& before, const TPose2D& after, const TrackerOptions& options)
{
  const double turn = mrpt::math::wrapToPi(after.phi - before.phi);
  return travelOf({after.x - before.x, after.y - before.y, turn}, options);
}
}  // namespace sigloc
