// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <vector>

#include "sigloc/features/Feature.h"
#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Returns how many independent facts about the observed features the map explains when the robot
/// stands at `pose`: a wall's offset counts one, however many pieces of it are seen, a wall end
/// one, a circle two. \cite algorithm eq. (7.5)
std::uint32_t explainedFacts(const std::vector<Feature>& observed, const DenseField& field,
                             const mrpt::math::TPose2D& pose);
}  // namespace sigloc
