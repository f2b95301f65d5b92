// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "arguments.h"

namespace sigloc
{
/// Checks the map, prints the table and writes the folder. Throws std::runtime_error.
void runCheck(const MapArguments& arguments, const char* program);
}  // namespace sigloc
