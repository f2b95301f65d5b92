// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sigloc
{
/// A number in fixed notation, spelled alike in every locale; an empty string for NaN, so that a
/// cell of a table stays empty.
std::string fixedNumber(double value, int decimals);
}  // namespace sigloc
