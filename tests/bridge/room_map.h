// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>

#include "bridge/rawlog_files.h"
#include "sigloc/plugin/SignatureMap.h"

namespace sigloc::test
{
inline constexpr float kHalfWidth = 4.0F;  // [m] of the room
inline constexpr float kHalfDepth = 2.5F;  // [m]

/// The scan that a full-circle laser takes at a pose in an empty rectangular room around the
/// origin.
inline mrpt::obs::CObservation2DRangeScan::Ptr roomScan(const mrpt::math::TPose2D& pose,
                                                        double time = 1)
{
  constexpr std::size_t kBeams = 361;
  auto scan = makeScan(time);
  scan->aperture = static_cast<float>(2 * M_PI);
  scan->resizeScan(kBeams);
  for (std::size_t i = 0; i < kBeams; ++i)
  {
    const double angle = pose.phi - M_PI + 2 * M_PI * static_cast<double>(i) / (kBeams - 1);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double to_x = std::abs(c) < 1e-9 ? 1e9 : (std::copysign(kHalfWidth, c) - pose.x) / c;
    const double to_y = std::abs(s) < 1e-9 ? 1e9 : (std::copysign(kHalfDepth, s) - pose.y) / s;
    scan->setScanRange(i, static_cast<float>(std::min(to_x, to_y)));
    scan->setScanRangeValidity(i, true);
  }
  return scan;
}

inline SignatureMap roomMap()
{
  SignatureMap map;
  for (const double x : {-1.0, 0.0, 1.0})
  {
    map.insertObservation(*roomScan({x, 0.2 * x, 0.0}),
                          mrpt::poses::CPose3D(x, 0.2 * x, 0, 0, 0, 0));
  }
  return map;
}
}  // namespace sigloc::test
