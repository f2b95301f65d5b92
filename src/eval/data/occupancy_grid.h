// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include "sigloc/map/map_building.h"

namespace sigloc::detail
{
/// Returns a raster as MRPT's grid map, with pf-localization's default likelihood options. So
/// MRPT's methods use the same map as ours.
mrpt::maps::COccupancyGridMap2D::Ptr occupancyGridOf(const OccupancyRaster& raster);
}  // namespace sigloc::detail
