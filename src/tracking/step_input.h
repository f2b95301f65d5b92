// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/features/ObservedScene.h"
#include "sigloc/geometry/GaussianPose.h"

namespace sigloc
{
/// Throws std::invalid_argument for a value that is not finite or a negative variance.
void checkMotion(const MotionIncrement& motion);

/// Throws std::invalid_argument for a return or a feature at a position that is not finite.
void checkScene(const ObservedScene& scene);
}  // namespace sigloc
