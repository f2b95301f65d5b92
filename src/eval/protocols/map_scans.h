// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "eval/data/evaluation_data.h"

namespace sigloc
{
/// Scans simulated in a map itself, with the noise of CBGL's experiments (Filotheou,
/// arXiv 2307.14247) for defaults. The map's error is common to 0.2 rad of a scan; CBGL's differs
/// from point to point, which averages out sooner.
struct MapScanOptions
{
  std::uint32_t count = 0;
  double view_deg = 360;  ///< of the laser, a beam a degree
  double range_sigma = 0.03;  ///< [m]
  double map_sigma = 0.05;  ///< [m]
  std::uint32_t seed = 1;
};

/// Returns queries from random places in the map's free space that keep 0.3 m from all else, at any
/// heading. Throws std::invalid_argument for a map without free space or options out of range.
std::vector<EvaluationQuery> scansInMap(const EvaluationMap& map, const MapScanOptions& options);
}  // namespace sigloc
