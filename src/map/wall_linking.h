// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "geometry/CellHash.h"
#include "sigloc/features/Feature.h"

namespace sigloc
{
/// Distance [m] up to which `segmentHash` finds the segments at a place.
constexpr double kSegmentReach = 0.5;

/// Returns the indices of all segments, hashed along their whole length: CellHash::forEachNear
/// finds, perhaps several times, each segment that comes within kSegmentReach of the place.
CellHash segmentHash(const std::vector<Feature>& features);
}  // namespace sigloc
