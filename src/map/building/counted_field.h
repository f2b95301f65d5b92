// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "map/building/BeamCounts.h"
#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Returns the dense field of all that was counted, cell by cell that of `buildDenseField` for the
/// whole raster. It is solved strip by strip, each of about `strip_cells` cells, and the counts are
/// forgotten on the way, so that little memory is needed besides. Where most of a frame of more
/// than `most_whole` cells was never seen, the field is in tiles, and only these are solved. Must
/// not be called on empty counts.
DenseField denseFieldOf(BeamCounts counts, std::uint32_t min_scans,
                        std::int32_t strip_cells = 1 << 22,
                        std::size_t most_whole = kMostWholeCells);
}  // namespace sigloc
