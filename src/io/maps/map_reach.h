// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "map/map_values.h"
#include "sigloc/io/map_files.h"

namespace sigloc::detail
{
/// Throws std::runtime_error ("path: reason") for a map with a pose or a corner beyondReach().
void requireWithinReach(const MapSource& source, const std::filesystem::path& path);
}  // namespace sigloc::detail
