// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <vector>

#include "sigloc/features/observe_scans.h"
#include "sigloc/features/ObservedScene.h"

namespace sigloc
{
/// Returns the features and returns of unordered points, in the robot frame [m], as a laser at
/// `origin` would see them: of points in one direction the nearest. `range_sigma` [m] is the
/// standard deviation of a range. Points that are not finite or are at the origin are skipped.
ObservedScene observePoints(const std::vector<mrpt::math::TPoint2D>& points,
                            const mrpt::math::TPoint2D& origin = {0, 0}, double range_sigma = 0.02,
                            const FeatureExtractorOptions& options = {});
}  // namespace sigloc
