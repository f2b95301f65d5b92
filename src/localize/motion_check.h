// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sigloc/localize/LocalizationRun.h"

namespace sigloc::detail
{
/// Compares how the poses of localized steps moved with what odometry says, in the robot's frame.
/// None where both are known for less than 2 m.
std::optional<OdometryMatch> matchOfOdometry(const std::vector<StepRecord>& steps);
}  // namespace sigloc::detail
