// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace sigloc
{
/// What is claimed about the robot's place.
enum class Verdict : std::uint8_t
{
  localized = 0,  ///< one pose holds with probability >= 0.99
  ambiguous = 1,  ///< several poses, or a line of poses, explain what is seen
  not_here = 2,  ///< nothing in the map explains what is seen
  too_little_seen = 3,  ///< too few returns or features to tell anything
};

/// "localized", "ambiguous", "not here", "too little seen".
const char* toString(Verdict verdict);
}  // namespace sigloc
