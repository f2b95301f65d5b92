// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sigloc/map/FeatureMap.h"

// What the pages have in common: the map in their data, and the script that draws it.

namespace sigloc::detail
{
/// Rounded to so many digits after the point, so that few are written.
double rounded(double value, int digits);

/// [x, y, phi], to millimetres.
nlohmann::ordered_json pagePose(const mrpt::math::TPose2D& pose);

/// Each segment as [x, y, x, y], anything else as [x, y], to centimetres.
nlohmann::ordered_json pageMarks(const std::vector<Feature>& features);

/// A map for the member `map` of a page's data: what colours mean, its box, its raster shrunk to at
/// most 1200 pixels, and its features where it has no raster.
nlohmann::ordered_json pageMap(const FeatureMap& map);

/// JSON that can stand within a script of a page.
std::string textForScript(const nlohmann::ordered_json& json);

/// Begins the script of a page. It reads `data` from the element `data`, and draws `data.map` on
/// the canvas `map`. The page's own script defines `drawMap()`, called when the view has changed.
extern const char* const kPageMapScript;
}  // namespace sigloc::detail
