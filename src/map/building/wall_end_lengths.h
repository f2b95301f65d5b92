// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sigloc/features/Feature.h"

namespace sigloc
{
/// Gives mapped wall ends the lengths of the linked walls behind them.
void setWallEndLengths(std::vector<Feature>& features);
}  // namespace sigloc
