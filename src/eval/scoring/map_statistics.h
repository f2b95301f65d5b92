// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "config/columns.h"
#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
/// What the maps of a run hold and cost, summed where a run has several.
struct MapStatistics
{
  std::size_t maps = 0;
  std::size_t features = 0;
  std::size_t bytes = 0;  ///< as a .sigmap holds them, not compressed
  double build_seconds = 0;  ///< CPU time

  void add(const FeatureMap& map, double seconds);
};

/// The object "map" of summary.json.
Columns<MapStatistics> mapColumns();

/// The same as a section of report.md.
std::string mapSection(const MapStatistics& statistics);
}  // namespace sigloc
