// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/particles/scan_reliability.h"

#include <mrpt/obs/CObservation2DRangeScanWithUncertainty.h>

namespace sigloc
{
double scanReliability(const mrpt::maps::COccupancyGridMap2D& grid,
                       const mrpt::obs::CObservation2DRangeScan& observed, const GaussianPose& pose)
{
  using mrpt::maps::COccupancyGridMap2D;
  COccupancyGridMap2D::TLaserSimulUncertaintyParams simulation;
  simulation.method = COccupancyGridMap2D::sumUnscented;
  simulation.robotPose.mean = mrpt::poses::CPose2D(pose.mean);
  simulation.robotPose.cov = pose.covariance;
  simulation.aperture = observed.aperture;
  simulation.rangeNoiseStd = observed.stdError;
  simulation.nRays = observed.getScanSize();
  simulation.rightToLeft = observed.rightToLeft;
  simulation.sensorPose = observed.sensorPose;
  simulation.maxRange = observed.maxRange;
  COccupancyGridMap2D::TLaserSimulUncertaintyResult expected;
  grid.laserScanSimulatorWithUncertainty(simulation, expected);
  return expected.scanWithUncert.evaluateScanLikelihood(observed, {});
}
}  // namespace sigloc
