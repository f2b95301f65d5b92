// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace sigloc
{
/// Returns what is wrong with the arguments that CLI11 refuses, in a line that names the one at
/// fault and tells what to type.
std::string wrongUse(const CLI::App& app, const CLI::ParseError& error);
}  // namespace sigloc
