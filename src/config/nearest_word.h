// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sigloc::detail
{
/// Returns the known word that didYouMean() names, or an empty text.
std::string nearestWord(const std::string& word, const std::vector<std::string>& known);
}  // namespace sigloc::detail
