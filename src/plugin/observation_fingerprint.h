// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <cstdint>

namespace sigloc
{
/// Identifies an observation and the options that its points are extracted with. An address alone
/// is not enough, because freed memory is used again.
std::uint64_t fingerprintOf(const mrpt::obs::CObservation& observation, std::size_t max_points);
}  // namespace sigloc
