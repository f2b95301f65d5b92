// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/generation/PatternIndex.h"

#include <vector>

namespace sigloc
{
/// Positions of a pattern's members in the order its shape is written in.
using PatternOrder = std::array<std::uint8_t, kLargestPattern>;

/// Returns the one order that a mapped pattern is stored under: the longest side first, from the
/// end that the other members are nearer to, then those by their place along it.
PatternOrder canonicalOrder(const mrpt::math::TPoint2D* places, std::size_t count);

/// Appends every order that an observed pattern's mapped counterpart may be stored under, when
/// differences below `tolerance` [m] may turn out either way; the canonical one among them.
void possibleOrders(const mrpt::math::TPoint2D* places, std::size_t count, double tolerance,
                    std::vector<PatternOrder>& orders);
}  // namespace sigloc
