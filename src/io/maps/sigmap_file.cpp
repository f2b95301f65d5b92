// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/io/map_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "io/archive/file_fault.h"
#include "io/archive/gzip_input.h"
#include "io/archive_values.h"
#include "io/maps/feature_archive.h"
#include "map/field_tiles.h"
#include "map/map_values.h"
#include "sigloc/io/file_output.h"

namespace sigloc
{
using detail::fail;
using mrpt::serialization::CArchive;

namespace
{
// The whole file is one zstd frame, or of older versions one gzip member, whose own checksum covers
// every byte of it.
constexpr char kMagic[] = "sigloc-map\n";
constexpr std::size_t kMagicSize = sizeof(kMagic) - 1;
constexpr std::uint8_t kBodyVersion = 4;  // the field is in tiles
constexpr std::uint8_t kWholeVersion = 3;  // the field's whole frame is stored
constexpr std::uint8_t kOldestBodyVersion = 2;  // it lacks the error of the map's turn
constexpr std::uint64_t kMostSkipped = 1ULL << 28U;  // bytes, which take half a second.
// A hall that is empty packs to a thousandth or less, so a map of the largest raster, of four bytes
// a cell, is always read. More than that is no map unless its file is large, too.
constexpr detail::UnpackLimits kLimits{detail::kUsualLimits.most,
                                       4 * static_cast<std::uint64_t>(kMostCells)};
constexpr std::uint64_t kLarge = 1ULL << 26U;  // bytes
constexpr std::size_t kBlockCells = 1U << 16U;
constexpr std::size_t kCellBytes = 4;
constexpr std::uint32_t kLongestText = 1U << 16U;

// A file has distances in half the field's unit, and 255 for all that are farther. Odd ones are of
// older versions.
constexpr std::uint8_t kFarByte = 255;

std::uint8_t distanceByte(std::uint8_t distance)
{
  return distance < DenseCell::kFar ? static_cast<std::uint8_t>(2 * distance) : kFarByte;
}

std::uint8_t distanceOfByte(std::uint8_t byte)
{
  const int nearest = std::min((byte + 1) / 2, DenseCell::kFar - 1);
  return byte < kFarByte ? static_cast<std::uint8_t>(nearest) : DenseCell::kFar;
}

// Cells are written in blocks of four planes. Equal bytes are next to each other, so that the
// lowest level of compression is both quick and small. A reader allocates no more than the file has
// data for.
void writeCells(const DenseCells& cells, std::size_t from, CArchive& out)
{
  std::vector<std::uint8_t> planes(4 * kBlockCells);
  for (std::size_t first = from; first < cells.size(); first += kBlockCells)
  {
    const std::size_t n = std::min(kBlockCells, cells.size() - first);
    for (std::size_t i = 0; i < n; ++i)
    {
      const DenseCell& cell = cells[first + i];
      planes[i] = distanceByte(cell.distance());
      planes[n + i] = static_cast<std::uint8_t>(cell.dx);
      planes[2 * n + i] = static_cast<std::uint8_t>(cell.dy);
      planes[3 * n + i] = static_cast<std::uint8_t>(cell.state());
    }
    out.WriteBuffer(planes.data(), 4 * n);
  }
}

/// How many cells of a field are free, and how many are walls.
struct CellCounts
{
  std::uint64_t free = 0, walls = 0;
};

/// Adds the counts of a plane of states.
void countStates(const std::uint8_t* states, std::size_t n, CellCounts& counts)
{
  // Counts of few enough to fit a byte: sixteen of those are added at a time.
  constexpr std::size_t kFew = 255;
  std::uint8_t largest = 0;
  for (std::size_t begin = 0; begin < n; begin += kFew)
  {
    std::uint8_t free = 0;
    std::uint8_t walls = 0;
    for (std::size_t i = begin; i < std::min(n, begin + kFew); ++i)
    {
      free = static_cast<std::uint8_t>(
          free + (states[i] == static_cast<std::uint8_t>(CellState::free) ? 1 : 0));
      walls = static_cast<std::uint8_t>(
          walls + (states[i] >= static_cast<std::uint8_t>(CellState::wall) ? 1 : 0));
      largest = std::max(largest, states[i]);
    }
    counts.free += free;
    counts.walls += walls;
  }
  if (largest > static_cast<std::uint8_t>(CellState::solid_wall))
  {
    throw detail::BadContent("a cell of no known state");
  }
}

/// Appends the cells of four planes.
void joinPlanes(const std::uint8_t* planes, std::size_t n, DenseCells& cells)
{
  for (std::size_t i = 0; i < n; ++i)
  {
    DenseCell cell(static_cast<CellState>(planes[3 * n + i]), distanceOfByte(planes[i]));
    cell.dx = static_cast<std::int8_t>(planes[n + i]);
    cell.dy = static_cast<std::int8_t>(planes[2 * n + i]);
    cells.push_back(cell);
  }
}

/// Appends cells until there are `count`, and returns the counts of those.
CellCounts readCells(CArchive& in, std::size_t count, DenseCells& cells)
{
  CellCounts counts;
  std::vector<std::uint8_t> planes(4 * kBlockCells);
  while (cells.size() < count)
  {
    const std::size_t first = cells.size();
    const std::size_t n = std::min<std::size_t>(kBlockCells, count - first);
    if (in.ReadBuffer(planes.data(), 4 * n) != 4 * n) throw std::runtime_error("raster cut off");
    // No more is allocated than sixteen times what the file has shown to hold. A field whose frame
    // is stored whole is then moved once at most, early on.
    if (first + n > cells.capacity()) cells.reserve(std::min(count, 16 * (first + n)));
    countStates(&planes[3 * n], n, counts);
    joinPlanes(planes.data(), n, cells);
  }
  return counts;
}

/// Writes which tiles are stored, by their place in the frame.
void writeTiles(const DenseField& field, CArchive& out)
{
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stored;
  for (std::uint32_t k = 0; k < field.tiles.size(); ++k)
  {
    if (field.tiles[k] != 0) stored.emplace_back(field.tiles[k], k);
  }
  std::sort(stored.begin(), stored.end());
  out << static_cast<std::uint32_t>(stored.size());
  for (const auto& [tile, place] : stored) out << place;
}

/// Reads the places of the stored tiles, and returns how many there are.
std::uint32_t readTiles(CArchive& in, DenseField& field)
{
  field = tiledField(field.frame);
  std::uint32_t count = 0;
  in >> count;
  for (std::uint32_t tile = 1; tile <= count; ++tile)
  {
    std::uint32_t place = 0;
    in >> place;
    if (place >= field.tiles.size() || field.tiles[place] != 0)
    {
      throw detail::BadContent("a tile that is not in the raster, or is in it twice");
    }
    field.tiles[place] = tile;
  }
  return count;
}

void writeField(const DenseField& field, CArchive& out)
{
  out << field.frame.origin.x << field.frame.origin.y << field.frame.resolution << field.frame.width
      << field.frame.height << field.free_area << field.wall_cells;
  if (field.isTiled()) writeTiles(field, out);
  writeCells(field.cells, field.isTiled() ? DenseField::kTileCells : 0, out);
}

/// Throws where the sums of a field are not those of its cells.
void checkSums(const CellCounts& cells, double resolution, double free_area,
               std::uint32_t wall_cells)
{
  const double cell_area = resolution * resolution;
  const double counted = static_cast<double>(cells.free) * cell_area;
  constexpr double kRounding = 1e-6;
  if (wall_cells != cells.walls ||
      !(std::abs(free_area - counted) <= kRounding * (cell_area + counted)))
  {
    throw detail::BadContent("the raster's free area or wall cells are not those of its cells");
  }
}

DenseField readField(CArchive& in, bool in_tiles, const detail::Announced& last_announced)
{
  DenseField field;
  double free_area = 0;
  std::uint32_t wall_cells = 0;
  in >> field.frame.origin.x >> field.frame.origin.y >> field.frame.resolution >>
      field.frame.width >> field.frame.height >> free_area >> wall_cells;
  if (const auto flaw = flawOf(field.frame, in_tiles ? kMostTiledCells : kMostCells))
  {
    throw detail::BadContent(*flaw);
  }
  std::size_t count = std::size_t{field.frame.width} * field.frame.height;
  if (in_tiles) count = (std::size_t{readTiles(in, field)} + 1) * DenseField::kTileCells;
  if (last_announced) last_announced(kCellBytes * (count - field.cells.size()));
  const CellCounts counts = readCells(in, count, field.cells);
  checkSums(counts, field.frame.resolution, free_area, wall_cells);
  field.free_area = free_area;
  field.wall_cells = wall_cells;
  return field;
}
}  // namespace

void writeFeatureMap(const FeatureMap& map, CArchive& out)
{
  out << (map.field() && map.field()->isTiled() ? kBodyVersion : kWholeVersion);
  const MapProvenance& provenance = map.provenance();
  out << provenance.source_path << provenance.source_checksum << provenance.options_digest;
  const MapErrorModel& error = map.error();
  out << error.relative_constant << error.relative_slope << error.common_sigma
      << error.common_turn_sigma;
  out << static_cast<std::uint32_t>(map.features().size());
  for (const Feature& feature : map.features()) detail::writeFeature(feature, out);
  out << map.field().has_value();
  if (map.field()) writeField(*map.field(), out);
}

namespace
{
/// Tells what is to come: the bytes of the features, and those of the cells, with which it ends.
FeatureMap readBody(CArchive& in, const detail::Announced& features_announced,
                    const detail::Announced& cells_announced)
{
  std::uint8_t version = 0;
  in >> version;
  if (version < kOldestBodyVersion || version > kBodyVersion)
  {
    const bool newer = version > kBodyVersion;
    throw detail::BadContent(
        fmt::format("feature map of version {}, this sigloc reads versions {} to {}: {}", version,
                    kOldestBodyVersion, kBodyVersion,
                    newer ? "a newer sigloc made it, and is needed to read it" : "build it again"));
  }
  MapProvenance provenance;
  provenance.source_path = detail::readText(in, kLongestText);
  provenance.source_checksum = detail::readText(in, kLongestText);
  provenance.options_digest = detail::readText(in, kLongestText);
  MapErrorModel error;
  in >> error.relative_constant >> error.relative_slope >> error.common_sigma;
  if (version > kOldestBodyVersion) in >> error.common_turn_sigma;
  if (const auto flaw = flawOf(error)) throw detail::BadContent(*flaw);
  std::vector<Feature> features = detail::readFeatures(in, features_announced);
  const bool has_field = detail::readFlag(in);
  std::optional<DenseField> field;
  if (has_field)
    field = inTilesWhereSparse(readField(in, version > kWholeVersion, cells_announced));
  if (const auto flaw = flawOf(features)) throw detail::BadContent(*flaw);
  return FeatureMap(std::move(features), std::move(field), error, std::move(provenance));
}
}  // namespace

FeatureMap readFeatureMap(CArchive& in)
{
  return readBody(in, {}, {});
}

namespace
{
constexpr const char* kDamaged = ": truncated or damaged";

/// Why a file as a whole is none, whatever is in it: "path: reason".
class Unsound : public std::runtime_error
{
 public:
  using std::runtime_error::runtime_error;
};

/// Before memory is taken for a large map, its file must be sound to its end. Throws where it is
/// not, or does not end after `to_end` bytes.
void requireSound(const detail::GzipInput& input, std::optional<std::uint64_t> to_end)
{
  const std::uint64_t announced = to_end ? input.getPosition() + *to_end : UINT64_MAX;
  std::optional<std::uint64_t> size;
  try
  {
    size = input.wholeSize(announced);
  }
  catch (const std::runtime_error& error)
  {
    throw Unsound(error.what());
  }
  if (!size || (to_end && *size != announced)) throw Unsound(input.path().string() + kDamaged);
}

FeatureMap readSigmap(const std::filesystem::path& path)
{
  detail::GzipInput input(path);
  input.limitTo(kLimits, false);
  char magic[kMagicSize] = {};
  const std::size_t got = input.Read(magic, kMagicSize);
  if (std::memcmp(magic, kMagic, std::max<std::size_t>(got, 1)) != 0) fail(path, "not a .sigmap");
  if (input.contents().cut_off) fail(path, "truncated or damaged");
  const auto features_announced = [&](std::uint64_t bytes)
  {
    if (bytes > kLarge) requireSound(input, std::nullopt);
  };
  const auto cells_announced = [&](std::uint64_t bytes)
  {
    if (bytes > kLarge) requireSound(input, bytes);
  };
  std::string reason;
  try
  {
    auto archive = mrpt::serialization::archiveFrom(input);
    FeatureMap map = readBody(archive, features_announced, cells_announced);
    if (input.atEnd() && !input.damaged()) return map;
  }
  catch (const detail::BadContent& error)
  {
    reason = error.what();
  }
  catch (const Unsound&)
  {
    throw;
  }
  catch (const std::exception&)
  {
    // Cut off, or damaged so that MRPT's archive stumbles.
  }
  // Of a damaged file, no other reason can be believed. Its checksum comes last.
  input.skipToEnd(kMostSkipped);
  fail(path, reason.empty() || input.damaged() ? "truncated or damaged" : reason);
}
}  // namespace

void saveSigmap(const FeatureMap& map, const std::filesystem::path& path)
{
  // Maps are written often and read more often.
  writeObjects(
      path,
      [&](CArchive& archive)
      {
        archive.WriteBuffer(kMagic, kMagicSize);
        writeFeatureMap(map, archive);
      },
      Packing::zstd);
}

FeatureMap loadSigmap(const std::filesystem::path& path)
{
  return readSigmap(path);
}
}  // namespace sigloc
