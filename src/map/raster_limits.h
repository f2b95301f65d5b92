// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace sigloc
{
/// Returns why cells of this size [m] cannot be used, or nullopt where they can: a dense field
/// needs cells of 5 mm to 1 m.
std::optional<std::string> unusableCells(double resolution);
}  // namespace sigloc
