// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

namespace sigloc::detail
{
/// A row of a picture, as a map server sees it. Rows come from the top.
struct GrayRow
{
  std::uint32_t width = 0;  ///< [pixels]
  std::uint32_t height = 0;  ///< [pixels] of the picture
  std::uint32_t y = 0;
  std::vector<std::uint8_t> shades;  ///< of each pixel the mean of the colours; 0 is black
  std::vector<std::uint8_t> alphas;  ///< the same, 255 is opaque; empty for a picture without
};

/// Reads a PGM or PNG file of at most kMostCells pixels without printing anything, and hands out
/// its rows: a large picture is never in memory. Throws std::runtime_error ("path: reason") for a
/// file that is none, is cut off or damaged, or is no regular file.
void readGrayImage(const std::filesystem::path& path,
                   const std::function<void(const GrayRow&)>& take);
}  // namespace sigloc::detail
