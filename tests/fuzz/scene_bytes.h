// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace sigloc::fuzz
{
// How the bytes of the target `scene` are read. The first one's lowest bit chooses the map with
// landmarks alone. Each step begins with a byte of these flags.
constexpr unsigned kMotion = 1;
constexpr unsigned kOddScan = 2;  ///< its angles, ranges and mount are in the bytes too
constexpr unsigned kSecondScan = 4;
constexpr unsigned kLandmarks = 8;
constexpr unsigned kSpoiltScene = 16;
constexpr unsigned kRelocate = 32;  ///< ask SignatureMatcher::localize() too
constexpr unsigned kNoScan = 64;

// Numbers are thousandths of a metre or radian, in two bytes. These stand for others.
constexpr std::int16_t kNotANumber = 32767;
constexpr std::int16_t kInfinite = 32766;
constexpr std::int16_t kHuge = 32765;
constexpr std::int16_t kTiny = 32764;
}  // namespace sigloc::fuzz
