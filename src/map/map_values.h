// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
// The one check of a map's values, whether they come from a file, an archive or a call. It is made
// before memory is allocated for what they announce.

/// A raster of more cells, or a map with a longer outline [m], is refused. Their memory is up to 7
/// GB and 150 MB.
constexpr double kMostCells = 4e8;
/// The same for a field in tiles: 6.3 km x 6.3 km of 5 cm. Only tiles with something in them are
/// stored.
constexpr double kMostTiledCells = 1.6e10;
constexpr double kLongestOutline = 1.5e6;

/// Returns why a map cannot hold the position (x, y) [m], or nullopt where it can. Positions are
/// kept as single floats. Far from the origin these are no longer good to a centimetre.
std::optional<std::string> beyondReach(double x, double y);

/// Returns why cells of this size [m] cannot be used, or nullopt where they can: a dense field
/// needs cells of 5 mm to 1 m.
std::optional<std::string> unusableCells(double resolution);

/// Return why these values cannot be those of a map, or nullopt where they can.
std::optional<std::string> flawOf(const RasterFrame& frame, double most_cells = kMostCells);
std::optional<std::string> flawOf(const DenseField& field);
std::optional<std::string> flawOf(const MapErrorModel& error);
std::optional<std::string> flawOf(const std::vector<Feature>& features);
}  // namespace sigloc
