// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sigloc
{
/// Returns "a, b, c".
std::string joined(const std::vector<std::string>& words);

/// Throws std::invalid_argument that names the known methods.
[[noreturn]] void refuseMethod(const std::string& name, const std::vector<std::string>& known);

/// Throws std::invalid_argument for an empty list, an unknown name or one given twice.
void checkMethodNames(const std::vector<std::string>& names, const std::vector<std::string>& known);
}  // namespace sigloc
