// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Returns a field in tiles with nothing in them.
DenseField tiledField(const RasterFrame& frame);

/// Stores a tile of a field in tiles, by its place in the frame, row by row. A tile with nothing in
/// it is not stored.
void storeTile(DenseField& field, std::size_t tile, const StoredCells& cells);

/// Returns the field with its whole frame stored. Throws std::invalid_argument where that would be
/// too large.
DenseField wholeField(const DenseField& field);

/// A field shrunk for a picture.
struct ShrunkField
{
  std::uint32_t width = 0;  ///< [pixels]
  std::uint32_t height = 0;
  std::vector<CellState> states;  ///< row by row from below
};

/// Returns a field in which a pixel has the highest state of `block` x `block` cells. A block with
/// a wall in it stays a wall, so that thin walls are kept.
ShrunkField shrunkField(const DenseField& field, std::uint32_t block);
}  // namespace sigloc
