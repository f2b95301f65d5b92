// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sigloc/io/map_files.h"

namespace sigloc::detail
{
/// Returns why a map cannot hold the position (x, y) [m], or nullopt where it can. Positions are
/// kept as single floats. Far from the origin these are no longer good to a centimetre.
std::optional<std::string> beyondReach(double x, double y);

/// Throws std::runtime_error ("path: reason") for a map with a pose, a corner or a feature beyond.
void requireWithinReach(const MapSource& source, const std::filesystem::path& path);
void requireWithinReach(const FeatureMap& map, const std::filesystem::path& path);
}  // namespace sigloc::detail
