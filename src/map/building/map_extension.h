// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sigloc/map/map_building.h"

namespace sigloc
{
/// Returns `map` extended by what posed scans saw: its features stay, features of the scans that it
/// does not have within the merge distances are added, and the scans overwrite the raster wherever
/// they know a cell. A map without a field keeps having none.
/// Throws std::invalid_argument when no scan has a valid return.
FeatureMap extendMap(const FeatureMap& map, const std::vector<PosedScans>& scans,
                     const MapBuildingOptions& options = {},
                     const FeatureExtractorOptions& extraction = {});
}  // namespace sigloc
