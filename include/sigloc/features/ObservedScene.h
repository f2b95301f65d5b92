// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/features/Feature.h"
#include "sigloc/features/LaserScan.h"

#include <vector>

namespace sigloc
{
/// Everything that the robot observed in one step, in the robot frame: the input of
/// `SignatureMatcher`.
struct ObservedScene
{
  std::vector<Feature> features;
  std::vector<BeamEnd> beams;  ///< all valid returns, ordered by scan and beam
  std::vector<mrpt::math::TPoint2D> sensor_origins;  ///< [m], one for each scan
};
}  // namespace sigloc
