// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <optional>

#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Returns the nearest point that distinguishes two poses, in the robot frame [m], 0.5 m to 8 m
/// away, behind walls or not. There the map has a wall for one pose. For the other it has nothing
/// but known free space within 0.5 m. Returns none where the map is the same around both. Points
/// are sampled 0.3 m apart. \cite algorithm section 8, "Publish"
std::optional<mrpt::math::TPoint2D> distinguishingPlace(const DenseField& field,
                                                        const mrpt::math::TPose2D& a,
                                                        const mrpt::math::TPose2D& b);
}  // namespace sigloc
