// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sigloc/map/map_building.h"

namespace sigloc
{
/// Returns `map` extended by posed scans. Its features stay. Features of the scans that it does not
/// have within the merge distances are added. The scans overwrite the raster in all cells that they
/// know. A map without a field gets none.
/// Throws std::invalid_argument when no scan has a valid return.
FeatureMap extendMap(const FeatureMap& map, const std::vector<PosedScans>& scans,
                     const MapBuildingOptions& options = {},
                     const FeatureExtractorOptions& extraction = {});
}  // namespace sigloc
