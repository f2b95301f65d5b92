// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <optional>

#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Returns where to look to tell two poses apart: the place nearest to the robot, in its own frame
/// [m] and 0.5 m to 8 m away, behind walls or not, where the map has a wall from one pose and
/// nothing but known free space within 0.5 m from the other. None where the map looks the same
/// around both. Samples 0.3 m apart.
std::optional<mrpt::math::TPoint2D> distinguishingPlace(const DenseField& field,
                                                        const mrpt::math::TPose2D& a,
                                                        const mrpt::math::TPose2D& b);
}  // namespace sigloc
