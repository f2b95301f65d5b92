// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/geometry/GaussianPose.h"

namespace sigloc
{
/// Throws std::invalid_argument for a value that is not finite, and for a covariance that is not
/// symmetric and positive semi-definite.
void checkMotion(const MotionIncrement& motion);
}  // namespace sigloc
