// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace sigloc
{
/// How hypotheses are generated; the modes of \cite algorithm section 4.
enum class GenerationMode : std::uint8_t
{
  automatic = 0,  ///< bases where a dense field backs the map, else patterns falling back to pairs
                  ///< and anchors
  plain = 1,  ///< (a) every signature
  anchors = 2,  ///< (b) sampled anchors and partners
  pairs = 3,  ///< (c) pair index
  patterns = 4,  ///< (d) larger patterns
  bases = 5,  ///< (e) small bases judged by the dense field
};
}  // namespace sigloc
