// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include "sigloc/tracking/TrackerOptions.h"

namespace sigloc
{
/// Returns how far [m] a robot went with a motion, turns of any sign and size included.
/// \cite algorithm eq. (8.2)
double travelOf(const mrpt::math::TPose2D& motion, const TrackerOptions& options);

/// Returns how far [m] a robot went that stands at `after` now, turning by less than half a turn.
/// \cite algorithm eq. (8.2)
double travelBetween(const mrpt::math::TPose2D& before, const mrpt::math::TPose2D& after,
                     const TrackerOptions& options);
}  // namespace sigloc
