// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// Maps: key frames and grids.
#include <fmt/core.h>
#include <mrpt/maps/COccupancyGridMap2D.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "io/archive/ArchiveWalk.h"
#include "map/map_values.h"

namespace sigloc::detail
{
namespace
{
/// True where MRPT, which goes by the bounds, comes to the number of cells that was written. Where
/// it does not, it takes cells for what comes after them, and that for a count.
bool agree(std::uint32_t cells, float from, float to, float resolution)
{
  const double spanned = (static_cast<double>(to) - from) / resolution;
  constexpr double kRounding = 1.5;  // of both bounds, and of single floats
  if (!(to > from && std::abs(spanned - cells) <= kRounding)) return false;  // NaN too
  const mrpt::maps::COccupancyGridMap2D row(from, to, 0, resolution, resolution);
  return row.getSizeX() == cells;
}
}  // namespace

void ArchiveWalk::simplemap(int version)
{
  constexpr std::size_t kLeast = 20;  // bytes of a key frame
  const ArchivePart pose =
      version == 0 ? ArchivePart::distribution_2d : ArchivePart::distribution_3d;
  for (std::size_t left = value<std::uint32_t>(); left > 0; --left)
  {
    try
    {
      object(only(pose));
      object(only(ArchivePart::entry));
      if (version >= 2) optionalTwist();
    }
    catch (const Unknown&)
    {
      // MRPT makes all key frames before it reads one, so their number must be possible.
      skip((left - 1) * kLeast);
      throw;
    }
  }
}

/// The speed that a key frame may have, as MRPT writes an std::optional.
void ArchiveWalk::optionalTwist()
{
  text();
  text();
  if (flag()) doubles(6);
}

void ArchiveWalk::gridMap(int version)
{
  const int bits = version >= 2 ? value<std::uint8_t>() : 8;
  if (bits != 8 && bits != 16) throw Unsound();
  const auto width = value<std::uint32_t>();
  const auto height = value<std::uint32_t>();
  const auto x_min = value<float>();
  const auto x_max = value<float>();
  const auto y_min = value<float>();
  const auto y_max = value<float>();
  RasterFrame frame;
  frame.origin = {x_min, y_min};
  frame.resolution = static_cast<double>(value<float>());
  frame.width = width;
  frame.height = height;
  if (const auto flaw = flawOf(frame)) throw Unsound(*flaw);
  const auto resolution = static_cast<float>(frame.resolution);
  if (!agree(width, x_min, x_max, resolution) || !agree(height, y_min, y_max, resolution))
  {
    throw Unsound(fmt::format("a raster of {} x {} cells that spans {:g} m x {:g} m", width, height,
                              x_max - x_min, y_max - y_min));
  }
  gridCells(std::size_t{width} * height, static_cast<std::size_t>(bits / 8));
  if (version == 0) return;
  constexpr std::size_t kInsertionOptions = 20;
  constexpr std::size_t kLikelihoodOptions = 58;
  skip(kInsertionOptions + kLikelihoodOptions);
  floats(count(sizeof(float)));
  skip(1);
  version >= 6 ? object(only(ArchivePart::map_parameters)) : skip(1);
  if (version >= 4) floats(2);
  if (version >= 5) skip(1);
}

/// Throws Unsound for a grid that holds nothing, before memory is taken for it: such grids pack
/// best.
void ArchiveWalk::gridCells(std::size_t count, std::size_t bytes)
{
  constexpr std::size_t kPiece = 1U << 16U;  // cells
  const std::string first(peeked(bytes));
  bool alike = true;
  for (std::size_t left = count; left > 0;)
  {
    const std::size_t n = std::min(left, kPiece);
    const std::string_view cells = peeked(n * bytes);
    // Cells are alike where each equals the one before it.
    alike = alike && cells.substr(0, bytes) == first &&
            cells.substr(bytes) == cells.substr(0, cells.size() - bytes);
    skip(n * bytes);
    left -= n;
  }
  if (alike) throw Unsound("all cells of its grid are alike");
}

void ArchiveWalk::mapParameters(int)
{
  skip(3);
}
}  // namespace sigloc::detail
