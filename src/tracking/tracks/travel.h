// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include "sigloc/tracking/TrackerOptions.h"

namespace sigloc
{
/// Returns the travel [m] of a motion: its distance, and its turn of any sign and size as a
/// distance. \cite algorithm eq. (8.2)
double travelOf(const mrpt::math::TPose2D& motion, const TrackerOptions& options);

/// Returns the travel [m] between two poses, with a turn of less than half a circle.
/// \cite algorithm eq. (8.2)
double travelBetween(const mrpt::math::TPose2D& before, const mrpt::math::TPose2D& after,
                     const TrackerOptions& options);
}  // namespace sigloc
