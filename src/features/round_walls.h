// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sigloc/features/Feature.h"

namespace sigloc
{
/// Returns for each feature whether it is a segment of a round wall: three or more segments that
/// are chords of one circle, also where something hides parts of it. The features of a scan must be
/// in the order of its beams. \cite algorithm eq. (7.7)
std::vector<bool> onRoundWalls(const std::vector<Feature>& features);
}  // namespace sigloc
