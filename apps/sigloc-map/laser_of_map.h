// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "sigloc/io/map_files.h"
#include "sigloc/map/sensor_model.h"

namespace sigloc
{
/// Returns the laser that took the scans of a map source: beams, angles, range and mount of its
/// first scan, and errors as all of them tell. A source without scans gives that of the defaults.
SimulatedLaserOptions laserOfMap(const MapSource& source);

/// Reads the section [laser] of an ini; keys that are absent keep the value of `defaults`. Throws
/// std::runtime_error ("file: reason").
SimulatedLaserOptions readLaser(const std::filesystem::path& ini,
                                const SimulatedLaserOptions& defaults);
}  // namespace sigloc
