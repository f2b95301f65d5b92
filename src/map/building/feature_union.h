// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sigloc/features/Feature.h"
#include "sigloc/map/map_building.h"

namespace sigloc
{
/// Returns the features of a map and, after them, those `seen` that it does not have within the
/// merge distances.
std::vector<Feature> unionOf(const std::vector<Feature>& mapped, const std::vector<Feature>& seen,
                             const MapBuildingOptions& options);
}  // namespace sigloc
