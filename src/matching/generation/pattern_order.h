// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/generation/PatternIndex.h"

#include <vector>

namespace sigloc
{
/// Positions of a pattern's members in the order of its shape.
using PatternOrder = std::array<std::uint8_t, kLargestPattern>;

/// Returns the order under which a mapped pattern is stored. The longest side comes first, from the
/// end that the other members are nearer to. The others follow by their position along it.
PatternOrder canonicalOrder(const mrpt::math::TPoint2D* places, std::size_t count);

/// Appends every order under which the mapped counterpart of an observed pattern may be stored,
/// where differences below `tolerance` [m] may have either sign. The canonical one is among them.
void possibleOrders(const mrpt::math::TPoint2D* places, std::size_t count, double tolerance,
                    std::vector<PatternOrder>& orders);
}  // namespace sigloc
