// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/archive/ArchiveWalk.h"
#include "io/archive/checked_archive.h"
#include "io/archive/gzip_input.h"
#include "io/maps/map_source_readers.h"
#include "io/maps/occupancy_grid.h"
#include "io/points/number_fields.h"
#include "io/points/points_raster.h"

namespace sigloc::detail
{
namespace
{
constexpr char kObjectEnd = '\x88';  // the last byte of each object that MRPT writes
constexpr std::string_view kMulti = "CMultiMetricMap";
constexpr std::string_view kGrid = "COccupancyGridMap2D";
constexpr std::string_view kLandmarks = "CLandmarksMap";
constexpr const char* kAdvice = "; landmarks are read from a .csv file with a row x,y for each";
constexpr std::array<std::string_view, 5> kPoints = {"CSimplePointsMap", "CColouredPointsMap",
                                                     "CWeightedPointsMap", "CPointsMapXYZIRT",
                                                     "CPointsMapXYZI"};

std::string_view withoutNamespace(std::string_view name)
{
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// Returns where an object of a class begins at `from` or later. An object's length is not told, so
/// its head is searched for.
std::optional<std::size_t> findObject(std::string_view bytes, std::size_t from,
                                      std::string_view name)
{
  constexpr std::string_view kNamespace = "mrpt::maps::";
  for (std::size_t at = bytes.find(name, from); at != std::string_view::npos;
       at = bytes.find(name, at + 1))
  {
    for (const std::size_t before : {std::size_t{1}, kNamespace.size() + 1})
    {
      if (at < from + before) continue;
      const auto header = objectHeaderIn(bytes.substr(at - before, kLongestObjectHeader));
      if (header && !header->old && withoutNamespace(header->name) == name) return at - before;
    }
  }
  return std::nullopt;
}

/// Returns where the first map of points begins at `from` or later.
std::optional<std::size_t> findPoints(std::string_view bytes, std::size_t from)
{
  std::optional<std::size_t> first;
  for (const std::string_view name : kPoints)
  {
    const auto at = findObject(bytes, from, name);
    if (at && (!first || *at < *first)) first = at;
  }
  return first;
}

/// Returns the grid map that begins at a place of the file, or nullopt for one that is damaged or
/// makes no map.
std::optional<OccupancyRaster> gridAt(const std::filesystem::path& path, std::size_t at)
{
  GzipInput input(path);
  std::vector<char> before(at);
  input.Read(before.data(), before.size());
  if (soundnessOfNext(input, only(ArchivePart::grid_map)) != Soundness::sound) return std::nullopt;
  mrpt::maps::COccupancyGridMap2D grid;
  try
  {
    auto archive = mrpt::serialization::archiveFrom(input);
    archive.ReadObject(&grid);
  }
  catch (const std::exception&)
  {
    return std::nullopt;
  }
  OccupancyRaster raster = rasterOf(grid);
  return unusableGrid(raster) ? std::nullopt : std::optional(std::move(raster));
}

/// The points or landmarks of a map.
struct Items
{
  std::uint32_t count = 0;  // as it is told
  std::string_view bytes;  // of them and of all that follows
};

/// Returns those of the map whose head is at a place, or nullopt where the file ends before.
std::optional<Items> itemsAt(std::string_view bytes, std::size_t at)
{
  const auto header = objectHeaderIn(bytes.substr(at, kLongestObjectHeader));
  Items items;
  items.bytes = bytes.substr(std::min(at + header->size + 1, bytes.size()));
  if (items.bytes.size() < sizeof(items.count)) return std::nullopt;
  std::memcpy(&items.count, items.bytes.data(), sizeof(items.count));
  items.bytes.remove_prefix(sizeof(items.count));
  return items;
}

/// Returns the points of a map of points whose head is at a place: all of MRPT's begin alike.
std::optional<PointList> pointsAt(std::string_view bytes, std::size_t at)
{
  const auto items = itemsAt(bytes, at);
  if (!items) return std::nullopt;
  const std::size_t axis = items->count * sizeof(float);
  const std::string_view rest = items->bytes;
  if (items->count == 0 || rest.size() / 3 < axis) return std::nullopt;
  PointList points;
  for (std::size_t i = 0; i < items->count; ++i)
  {
    std::array<float, 3> at_axis{};
    for (std::size_t k = 0; k < at_axis.size(); ++k)
      std::memcpy(&at_axis[k], rest.data() + k * axis + i * sizeof(float), sizeof(float));
    addPoint(points, static_cast<double>(at_axis[0]), static_cast<double>(at_axis[1]),
             static_cast<double>(at_axis[2]));
  }
  return points;
}

struct Found
{
  std::optional<OccupancyRaster> grid;
  std::optional<PointList> points;
  bool more = false;  // of what was found
  bool landmarks = false;  // which are not read
};

/// Keeps the first map of a kind, and notes that there are others.
template <class Map>
void keepFirst(std::optional<Map> map, std::optional<Map>& first, bool& more)
{
  if (!map) return;
  more = first.has_value();
  if (!first) first = std::move(map);
}

/// Looks for the first grid map in a file, else for the first map of points, and for landmarks.
Found lookIn(const std::filesystem::path& path)
{
  GzipInput input(path);
  const auto header = objectHeaderIn(input.peek(kLongestObjectHeader));
  if (!header || header->old) fail(path, "not an MRPT file");
  const std::string_view name = withoutNamespace(header->name);
  const bool single =
      name == kGrid || std::find(kPoints.begin(), kPoints.end(), name) != kPoints.end();
  if (!single && name != kMulti)
  {
    fail(path, "holds a '" + std::string(header->name) + "', not a map of a grid or of points" +
                   (name == kLandmarks ? kAdvice : ""));
  }
  const std::size_t head = header->size;
  requireIntact(path, kGridLimits);
  input.limitTo(kGridLimits);
  const std::string all = restOf(input);
  const std::string_view bytes = all;
  if (bytes.back() != kObjectEnd) fail(path, "truncated or damaged");
  const std::size_t from = single ? 0 : head + 1;
  Found found;
  const auto landmarks = findObject(bytes, from, kLandmarks);
  const auto items = landmarks ? itemsAt(bytes, *landmarks) : std::nullopt;
  found.landmarks = items && items->count > 0;
  for (auto at = findObject(bytes, from, kGrid); at && !found.more;
       at = findObject(bytes, *at + 2, kGrid))
  {
    keepFirst(gridAt(path, *at), found.grid, found.more);
  }
  if (found.grid) return found;
  for (auto at = findPoints(bytes, from); at && !found.more; at = findPoints(bytes, *at + 2))
  {
    keepFirst(pointsAt(bytes, *at), found.points, found.more);
  }
  return found;
}
}  // namespace

bool isMultiMap(const std::filesystem::path& path)
{
  requireFile(path);
  GzipInput input(path);
  return withoutNamespace(input.nextClassName()) == kMulti;
}

OccupancyRaster readMetricMap(const std::filesystem::path& path, const ReadingOptions& reading)
{
  Found found = lookIn(path);
  if (found.grid) return std::move(*found.grid);
  if (!found.points)
  {
    fail(path,
         std::string("holds neither a grid map with walls and free cells nor a map of points") +
             (found.landmarks ? kAdvice : ""));
  }
  OccupancyRaster raster = rasterOfPoints(*found.points, reading, path);
  requireWallAndFree(raster, path);
  return raster;
}

std::string warningOfMetricMap(const std::filesystem::path& path)
{
  const Found found = lookIn(path);
  std::vector<std::string> warnings;
  if (!found.grid) warnings.emplace_back(kNoFreeSpace);
  if (found.more)
  {
    warnings.emplace_back(found.grid ? "only the first of its grid maps is read"
                                     : "only the first of its maps of points is read");
  }
  if (found.landmarks) warnings.emplace_back("its landmarks are left out");
  return fmt::format("{}", fmt::join(warnings, "; "));
}
}  // namespace sigloc::detail
