// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace sigloc::detail
{
/// A picture as a map server sees it, row by row from the top.
struct GrayImage
{
  std::uint32_t width = 0;  ///< [pixels]
  std::uint32_t height = 0;  ///< [pixels]
  std::vector<std::uint8_t> shades;  ///< width * height, mean of the colours; 0 is black
  std::vector<std::uint8_t> alphas;  ///< the same, 255 is opaque; empty for a picture without
};

/// Reads a PGM or PNG file of at most kMostCells pixels without printing anything. Throws
/// std::runtime_error ("path: reason") for a file that is none, is cut off or damaged, or is no
/// regular file.
GrayImage readGrayImage(const std::filesystem::path& path);
}  // namespace sigloc::detail
