// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/io/map_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "io/gzip_input.h"
#include "io/maps/feature_archive.h"
#include "io/maps/map_reach.h"
#include "sigloc/io/file_output.h"

namespace sigloc
{
using mrpt::serialization::CArchive;

namespace
{
// The whole file is one gzip member, whose own checksum covers every byte of it.
constexpr char kMagic[] = "sigloc-map\n";
constexpr std::size_t kMagicSize = sizeof(kMagic) - 1;
constexpr std::uint8_t kBodyVersion = 3;
constexpr std::uint8_t kOldestBodyVersion = 2;  // it lacks the error of the map's turn
constexpr std::size_t kBlockCells = 1U << 16U;
constexpr std::size_t kFirstReserve = 1U << 14U;
constexpr std::uint64_t kMostCells = 1ULL << 31U;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason)
{
  throw std::runtime_error(path.string() + ": " + reason);
}

// Cells are written in blocks of four planes. Equal bytes are next to each other, so that the
// lowest level of compression is both quick and small. A reader allocates no more than the file has
// data for.
void writeField(const DenseField& field, CArchive& out)
{
  out << field.frame.origin.x << field.frame.origin.y << field.frame.resolution << field.frame.width
      << field.frame.height << field.free_area << field.wall_cells;
  std::vector<std::uint8_t> planes(4 * kBlockCells);
  for (std::size_t first = 0; first < field.cells.size(); first += kBlockCells)
  {
    const std::size_t n = std::min(kBlockCells, field.cells.size() - first);
    for (std::size_t i = 0; i < n; ++i)
    {
      const DenseCell& cell = field.cells[first + i];
      planes[i] = cell.distance;
      planes[n + i] = static_cast<std::uint8_t>(cell.dx);
      planes[2 * n + i] = static_cast<std::uint8_t>(cell.dy);
      planes[3 * n + i] = static_cast<std::uint8_t>(cell.state);
    }
    out.WriteBuffer(planes.data(), 4 * n);
  }
}

DenseField readField(CArchive& in)
{
  DenseField field;
  in >> field.frame.origin.x >> field.frame.origin.y >> field.frame.resolution >>
      field.frame.width >> field.frame.height >> field.free_area >> field.wall_cells;
  const std::uint64_t count = std::uint64_t{field.frame.width} * field.frame.height;
  if (count > kMostCells || !(field.frame.resolution > 0)) throw std::runtime_error("bad raster");
  std::vector<std::uint8_t> planes(4 * kBlockCells);
  for (std::size_t first = 0; first < count; first += kBlockCells)
  {
    const std::size_t n = std::min<std::size_t>(kBlockCells, count - first);
    if (in.ReadBuffer(planes.data(), 4 * n) != 4 * n) throw std::runtime_error("raster cut off");
    // After the first block it is known that the file holds data.
    if (first == kBlockCells) field.cells.reserve(count);
    field.cells.resize(first + n);
    for (std::size_t i = 0; i < n; ++i)
    {
      DenseCell& cell = field.cells[first + i];
      cell.distance = planes[i];
      cell.dx = static_cast<std::int8_t>(planes[n + i]);
      cell.dy = static_cast<std::int8_t>(planes[2 * n + i]);
      if (planes[3 * n + i] > static_cast<std::uint8_t>(CellState::solid_wall))
      {
        throw std::runtime_error("unknown cell state");
      }
      cell.state = static_cast<CellState>(planes[3 * n + i]);
    }
  }
  return field;
}
}  // namespace

void writeFeatureMap(const FeatureMap& map, CArchive& out)
{
  out << kBodyVersion;
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

FeatureMap readFeatureMap(CArchive& in)
{
  std::uint8_t version = 0;
  in >> version;
  if (version < kOldestBodyVersion || version > kBodyVersion)
  {
    const bool newer = version > kBodyVersion;
    throw std::runtime_error(
        fmt::format("feature map of version {}, this sigloc reads versions {} to {}: {}", version,
                    kOldestBodyVersion, kBodyVersion,
                    newer ? "a newer sigloc made it, and is needed to read it" : "build it again"));
  }
  MapProvenance provenance;
  in >> provenance.source_path >> provenance.source_checksum >> provenance.options_digest;
  MapErrorModel error;
  in >> error.relative_constant >> error.relative_slope >> error.common_sigma;
  if (version > kOldestBodyVersion) in >> error.common_turn_sigma;
  std::uint32_t count = 0;
  in >> count;
  std::vector<Feature> features;
  features.reserve(std::min<std::size_t>(count, kFirstReserve));
  for (std::uint32_t i = 0; i < count; ++i) features.push_back(detail::readFeature(in));
  bool has_field = false;
  in >> has_field;
  std::optional<DenseField> field;
  if (has_field) field = readField(in);
  return FeatureMap(std::move(features), std::move(field), error, std::move(provenance));
}

namespace
{
FeatureMap readSigmap(const std::filesystem::path& path)
{
  detail::GzipInput input(path);
  char magic[kMagicSize] = {};
  const std::size_t got = input.Read(magic, kMagicSize);
  if (std::memcmp(magic, kMagic, std::max<std::size_t>(got, 1)) != 0) fail(path, "not a .sigmap");
  std::string reason = "truncated or damaged";
  try
  {
    auto archive = mrpt::serialization::archiveFrom(input);
    FeatureMap map = readFeatureMap(archive);
    if (input.atEnd() && !input.damaged()) return map;
  }
  catch (const std::exception& error)
  {
    const std::string what = error.what();
    if (what.find("feature map of version") != std::string::npos) reason = what;
  }
  fail(path, reason);
}
}  // namespace

void saveSigmap(const FeatureMap& map, const std::filesystem::path& path)
{
  // The lowest level of compression: maps are written often and read more often.
  writeObjects(
      path,
      [&](CArchive& archive)
      {
        archive.WriteBuffer(kMagic, kMagicSize);
        writeFeatureMap(map, archive);
      },
      kQuickCompression);
}

FeatureMap loadSigmap(const std::filesystem::path& path)
{
  FeatureMap map = readSigmap(path);
  detail::requireWithinReach(map, path);
  return map;
}
}  // namespace sigloc
