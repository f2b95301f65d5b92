// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eval/protocols/scale.h"

namespace sigloc::detail
{
/// Growth with the mapped area: relocation from one scan among `options.buildings` offices of one
/// size, each of its own seed, side by side in one map. Queries are from random poses.
/// Throws std::invalid_argument for a count of 0 and for an unknown method.
ScaleReport runAreaGrowth(const ScaleOptions& options);
}  // namespace sigloc::detail
