// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sigloc/features/Feature.h"
#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Returns the root mean square distance [m] from points along the segments of the map to the
/// ridges of their walls in the field, across the segments. 0 without segments. Thick or rough
/// walls make it large. \cite algorithm eq. (6.14)
double wallBlur(const std::vector<Feature>& features, const DenseField& field);
}  // namespace sigloc
