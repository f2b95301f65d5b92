// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include "sigloc/map/map_building.h"

namespace sigloc::detail
{
/// Returns a raster as MRPT's grid map, with the likelihood that pf-localization ships: for methods
/// of MRPT's to see the map that ours see.
mrpt::maps::COccupancyGridMap2D::Ptr occupancyGridOf(const OccupancyRaster& raster);
}  // namespace sigloc::detail
