// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sigloc/map/map_building.h"
#include "sigloc/map/sensor_model.h"

namespace sigloc
{
/// Returns a laser with `map_sigma` and `clutter_share` as the mapping scans tell them: every
/// second scan is compared with the raster of the others. Too few scans leave both as they are.
SimulatedLaserOptions withErrorsOf(const std::vector<PosedScans>& scans,
                                   SimulatedLaserOptions laser);
}  // namespace sigloc
