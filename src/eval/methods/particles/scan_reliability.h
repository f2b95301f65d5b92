// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "sigloc/geometry/GaussianPose.h"

namespace sigloc
{
/// Returns MRPT's measure, in [0, 1], of how well a scan fits what the grid predicts at an
/// uncertain pose (map_from_robot): laserScanSimulatorWithUncertainty (unscented),
/// evaluateScanLikelihood. pf-localization computes it with DO_RELIABILITY_ESTIMATE and never uses
/// it.
double scanReliability(const mrpt::maps::COccupancyGridMap2D& grid,
                       const mrpt::obs::CObservation2DRangeScan& observed,
                       const GaussianPose& pose);
}  // namespace sigloc
