// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <vector>

#include "map_alignment.h"

namespace sigloc
{
/// Returns the ridges of the solid walls of a field [m], at most `most` of them, evenly chosen; of
/// all walls where hardly any is solid.
std::vector<mrpt::math::TPoint2D> wallPoints(const DenseField& field, std::size_t most);

/// Refines the pose of points in a field by least squares, with its covariance, and tells how much
/// they explain. Points that stay far from every wall do not count.
void refinePose(const DenseField& a, const std::vector<mrpt::math::TPoint2D>& points_of_b,
                MapPose& pose);
}  // namespace sigloc
