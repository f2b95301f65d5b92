// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/io/map_files.h"

#include <fmt/format.h>
#include <mrpt/system/md5.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "io/archive/checked_archive.h"
#include "io/archive/file_fault.h"
#include "io/archive/gzip_input.h"
#include "io/archive/UnreadObservation.h"
#include "io/key_frames.h"
#include "io/maps/map_formats.h"
#include "io/maps/map_reach.h"
#include "io/maps/map_source_readers.h"
#include "io/points/points_raster.h"
#include "io/reading_check.h"
#include "io/scan_conversion.h"
#include "io/solid/SolidView.h"
#include "sigloc/config/plural.h"

namespace sigloc
{
namespace
{
/// Raised whenever the same source and options give another map than before.
constexpr int kBuildVersion = 10;

using detail::MapKind;

/// Some readers have options.
template <class Reader>
MapSource readBy(Reader reader, const std::filesystem::path& path, const ReadingOptions& reading)
{
  if constexpr (std::is_invocable_v<Reader, const std::filesystem::path&, const ReadingOptions&>)
  {
    return reader(path, reading);
  }
  else
  {
    return reader(path);
  }
}

MapSource readAs(MapKind kind, const std::filesystem::path& path, const ReadingOptions& reading)
{
  using namespace detail;
  switch (kind)
  {
#define SIGLOC_CASE(kind, reader, ...) \
  case MapKind::kind:                  \
    return readBy(reader, path, reading);
    SIGLOC_MAP_FORMATS(SIGLOC_CASE)
#undef SIGLOC_CASE
  }
  throw std::logic_error("a kind of map without a reader");
}

/// A map in a folder, of the kind that is listed first, or an empty text.
std::string didYouMeanMapIn(const std::filesystem::path& folder)
{
  std::optional<MapKind> best;
  std::string best_name;
  for (const std::string& name : detail::namesIn(folder))
  {
    const auto kind = detail::mapKindOf(name);
    if (!kind || (best && *best <= *kind)) continue;
    best = kind;
    best_name = name;
  }
  if (!best) return "; no map is in it";
  return "; did you mean '" + (folder / best_name).string() + "'?";
}

/// Throws for a folder: it is often given for the map in it.
void refuseFolder(const std::filesystem::path& path)
{
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    detail::fail(path, "is a folder, not a file" + didYouMeanMapIn(path));
}

void requireMapFile(const std::filesystem::path& path)
{
  refuseFolder(path);
  detail::requireFile(path);
}

MapKind kindOf(const std::filesystem::path& path)
{
  if (const auto kind = detail::mapKindOf(path)) return *kind;
  if (path.empty()) throw std::runtime_error("the name of the map is empty");
  requireMapFile(path);
  if (detail::extensionOf(path) == ".rawlog")
  {
    detail::fail(path, "a rawlog is the log of a drive, not a map; icp-slam makes a map of it");
  }
  std::vector<std::string> known;
  for (const detail::MapFormat& format : detail::mapFormats())
    known.insert(known.end(), format.extensions.begin(), format.extensions.end());
  detail::fail(path, fmt::format("unknown kind of map (known: {})", fmt::join(known, ", ")));
}

void appendBytes(const std::filesystem::path& path, std::string& bytes)
{
  detail::requireFile(path);
  const std::size_t before = bytes.size();
  bytes.resize(before + std::filesystem::file_size(path));
  std::ifstream in(path, std::ios::binary);
  in.read(bytes.data() + before, static_cast<std::streamsize>(bytes.size() - before));
}

std::string checksumOf(const std::filesystem::path& path)
{
  std::string bytes;
  for (const std::filesystem::path& file : filesOfMapSource(path)) appendBytes(file, bytes);
  return mrpt::system::md5(bytes);
}

template <class Options>
std::string textOf(const Options& options)
{
  std::string text;
  Options::visitFields(
      [&](const auto& field)
      {
        const auto value = static_cast<double>(options.*(field.member));
        text += fmt::format("{}={:.17g}\n", field.key, value);
      });
  return text;
}

std::string digestOf(const MapBuildingOptions& building, const FeatureExtractorOptions& extraction,
                     const ReadingOptions& reading)
{
  return mrpt::system::md5(fmt::format("build {}\n{}{}{}", kBuildVersion, textOf(building),
                                       textOf(extraction), textOf(reading)));
}

bool isFinite(const mrpt::poses::CPose2D& pose)
{
  return std::isfinite(pose.x()) && std::isfinite(pose.y()) && std::isfinite(pose.phi());
}

MapProvenance provenanceOf(const std::filesystem::path& path, const MapBuildingOptions& building,
                           const FeatureExtractorOptions& extraction, const ReadingOptions& reading)
{
  // The name alone: a map tells no one's folders, and equal maps are equal bytes.
  return {path.filename().string(), checksumOf(path), digestOf(building, extraction, reading)};
}

/// Saves a map for later runs, which can do without it.
void keepInCache(const FeatureMap& map, const std::filesystem::path& cache)
{
  std::error_code ignored;
  std::filesystem::create_directories(cache.parent_path(), ignored);
  try
  {
    saveSigmap(map, cache);
  }
  catch (const std::runtime_error&)
  {
    // No room, or no permission.
  }
}

/// A folder that an environment variable names, or an empty path.
std::filesystem::path folderNamedBy(const char* variable)
{
  const char* const value = std::getenv(variable);
  const std::filesystem::path folder = value == nullptr ? "" : value;
  return folder.is_absolute() ? folder : std::filesystem::path();
}

FeatureMap build(const std::filesystem::path& path, const MapBuildingOptions& building,
                 const FeatureExtractorOptions& extraction, const ReadingOptions& reading,
                 const MapProgress& progress)
{
  MapSource source = readMapSource(path, reading);
  // After reading, which refuses what is far too large for its checksum.
  const MapProvenance provenance = provenanceOf(path, building, extraction, reading);
  try
  {
    if (auto* scans = std::get_if<std::vector<PosedScans>>(&source))
    {
      return buildMapFromScans(std::move(*scans), building, extraction, provenance, progress);
    }
    if (const auto* raster = std::get_if<OccupancyRaster>(&source))
    {
      return buildMapFromRaster(*raster, building, extraction, provenance, progress);
    }
    return std::get<FeatureMap>(std::move(source)).madeOf(provenance);
  }
  catch (const std::invalid_argument& error)
  {
    detail::fail(path, error.what());
  }
}
}  // namespace

std::vector<PosedScans> posedScansOf(const mrpt::maps::CSimpleMap& simplemap)
{
  std::vector<PosedScans> posed_scans;
  for (std::size_t i = 0; i < simplemap.size(); ++i)
  {
    const auto [pose, frame] = keyFrameOf(simplemap, i);
    if (!pose || !frame) continue;
    const mrpt::poses::CPose2D mean(pose->getMeanVal());
    PosedScans posed;
    posed.map_from_robot = mean.asTPose();
    posed.scans = laserScansOf(*frame);
    if (posed.scans.empty()) posed.scans = planarCutsOf(*frame);
    if (isFinite(mean) && !posed.scans.empty()) posed_scans.push_back(std::move(posed));
  }
  return posed_scans;
}

bool isMapImage(const std::filesystem::path& path)
{
  return detail::mapKindOf(path) == MapKind::image;
}

std::string warningOfMapSource(const std::filesystem::path& path)
{
  constexpr double kOneFloor = 0.5;  // [m]
  if (kindOf(path) == MapKind::ros_map) return detail::warningOfRosMap(path);
  if (kindOf(path) == MapKind::metric_map) return detail::warningOfMetricMap(path);
  if (kindOf(path) == MapKind::gridmap)
    return detail::isMultiMap(path) ? detail::warningOfMetricMap(path) : "";
  if (kindOf(path) == MapKind::rows) return detail::warningOfRows(path);
  if (kindOf(path) == MapKind::points) return detail::kNoFreeSpace;
  if (kindOf(path) != MapKind::simplemap) return {};
  mrpt::maps::CSimpleMap simplemap;
  detail::readObjectFile(path, simplemap);
  std::size_t nowhere = 0;
  std::vector<double> heights;
  for (std::size_t i = 0; i < simplemap.size(); ++i)
  {
    const auto pose = keyFrameOf(simplemap, i).pose;
    if (!pose) continue;
    const mrpt::poses::CPose3D mean = pose->getMeanVal();
    if (!isFinite(mrpt::poses::CPose2D(mean)))
    {
      ++nowhere;
    }
    else if (std::isfinite(mean.z()))
    {
      heights.push_back(mean.z());
    }
  }
  if (nowhere > 0) return counted(nowhere, "key frame") + " left out, whose pose is no number";
  if (heights.empty()) return {};
  const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
  if (*highest - *lowest <= kOneFloor) return {};
  return "its key frames are at heights that differ; all are taken to be on one floor";
}

namespace detail
{
std::optional<MapKind> mapKindOf(const std::filesystem::path& path)
{
  const std::string extension = extensionOf(path);
  for (const MapFormat& format : mapFormats())
  {
    const auto& own = format.extensions;
    if (std::find(own.begin(), own.end(), extension) != own.end()) return format.kind;
  }
  return std::nullopt;
}

std::vector<PosedScans> readSimplemap(const std::filesystem::path& path,
                                      const ReadingOptions& reading)
{
  mrpt::maps::CSimpleMap simplemap;
  readObjectFile(path, simplemap);
  for (std::size_t i = 0; i < simplemap.size(); ++i)
  {
    const auto frame = keyFrameOf(simplemap, i).frame;
    if (!frame) continue;
    for (const auto& observation : *frame)
    {
      if (auto unread = std::dynamic_pointer_cast<UnreadObservation>(observation))
        cutPlanar(*unread, {reading.min_height, reading.max_height});
    }
  }
  std::vector<PosedScans> scans = posedScansOf(simplemap);
  if (scans.empty()) detail::fail(path, "no usable 2D laser scan in it");
  return scans;
}
}  // namespace detail

MapSource readMapSource(const std::filesystem::path& path, const ReadingOptions& reading)
{
  requireMapFile(path);
  detail::checkReading(reading);
  MapSource source = readAs(kindOf(path), path, reading);
  detail::requireWithinReach(source, path);
  return source;
}

std::vector<std::filesystem::path> filesOfMapSource(const std::filesystem::path& path)
{
  std::vector<std::filesystem::path> files = {path};
  if (kindOf(path) == MapKind::ros_map) files.push_back(detail::imageOfRosMap(path));
  return files;
}

FeatureMap buildMapFromFile(const std::filesystem::path& path, const MapBuildingOptions& building,
                            const FeatureExtractorOptions& extraction, const MapProgress& progress,
                            const ReadingOptions& reading)
{
  requireMapFile(path);
  FeatureMap map = kindOf(path) == MapKind::sigmap
                       ? loadSigmap(path)
                       : build(path, building, extraction, reading, progress);
  if (map.empty())
  {
    const std::string odd = map.field() ? detail::warningOfField(*map.field()) : "";
    detail::fail(path, "no feature found in it" + (odd.empty() ? "" : "; it " + odd));
  }
  return map;
}

std::filesystem::path mapCacheFile(const std::filesystem::path& source)
{
  constexpr std::size_t kDigits = 12;  // tell maps of one name in several folders apart
  std::filesystem::path root = folderNamedBy("XDG_CACHE_HOME");
  if (root.empty())
  {
    root = folderNamedBy("HOME");
    if (root.empty()) return {};
    root /= ".cache";
  }
  std::error_code unnameable;
  const auto whole = std::filesystem::weakly_canonical(source, unnameable);
  const std::string digest = mrpt::system::md5(whole.string()).substr(0, kDigits);
  return root / "sigloc" / fmt::format("{}.{}.sigmap", source.filename().string(), digest);
}

CachedMap mapWithCache(const std::filesystem::path& source, const std::filesystem::path& cache,
                       const MapBuildingOptions& building,
                       const FeatureExtractorOptions& extraction, const MapProgress& progress,
                       const ReadingOptions& reading)
{
  const auto start = std::chrono::steady_clock::now();
  requireMapFile(source);
  if (kindOf(source) == MapKind::sigmap)
  {
    return {buildMapFromFile(source, building, extraction), true, 0.0};
  }
  try
  {
    CachedMap cached{loadSigmap(cache), true, 0.0};
    const MapProvenance& found = cached.map.provenance();
    const MapProvenance wanted = provenanceOf(source, building, extraction, reading);
    if (found.source_checksum == wanted.source_checksum &&
        found.options_digest == wanted.options_digest && !cached.map.empty())
    {
      return cached;
    }
  }
  catch (const std::runtime_error&)
  {
    // One of the two is missing or unreadable: built and written anew, or refused, below.
  }
  CachedMap fresh;
  fresh.map = buildMapFromFile(source, building, extraction, progress, reading);
  keepInCache(fresh.map, cache);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  fresh.build_seconds = elapsed.count();
  return fresh;
}
}  // namespace sigloc
