// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sigloc/io/map_files.h"

namespace sigloc::detail
{
/// Returns why a map cannot hold what is at (x, y) [m], or nullopt: places are kept as single
/// floats, which so far from the origin are no longer good to a centimetre.
std::optional<std::string> beyondReach(double x, double y);

/// Throws std::runtime_error ("path: reason") for a map with a pose, a corner or a feature beyond.
void requireWithinReach(const MapSource& source, const std::filesystem::path& path);
void requireWithinReach(const FeatureMap& map, const std::filesystem::path& path);
}  // namespace sigloc::detail
