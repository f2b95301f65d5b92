// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace sigloc
{
/// Returns why a raster's cells of this size [m] are of no use, or nullopt: a dense field takes
/// cells of 5 mm to 1 m.
std::optional<std::string> unusableCells(double resolution);
}  // namespace sigloc
