// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sigloc/features/Feature.h"
#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Returns how far the ridges of walls in the field lie from the segments of the map, across these:
/// the root of the mean square [m] over points along all segments. In a map of few, thick or rough
/// wall cells it is large. 0 without segments. \cite algorithm eq. (6.14)
double wallBlur(const std::vector<Feature>& features, const DenseField& field);
}  // namespace sigloc
