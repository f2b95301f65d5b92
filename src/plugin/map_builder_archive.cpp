// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/map_builder_archive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "features/feature_values.h"
#include "io/archive_values.h"
#include "io/maps/feature_archive.h"
#include "io/options_archive.h"
#include "map/map_values.h"

namespace sigloc::detail
{
using mrpt::serialization::CArchive;

namespace
{
constexpr std::uint8_t kVersion = 1;
constexpr std::uint8_t kVersionWithoutSums = 0;  // hits are taken to be at cell centres

bool areSums(std::initializer_list<double> sums)
{
  constexpr double kLargest = 1e18;
  return std::all_of(sums.begin(), sums.end(),
                     [](double sum) { return std::abs(sum) <= kLargest; });  // false for NaN
}

/// A merged feature is derived from none, and where a map can hold it.
void requireOwn(const Feature& feature)
{
  auto flaw = flawOf(feature, 0);
  if (!flaw) flaw = beyondReach(feature.position.x, feature.position.y);
  if (flaw) throw BadContent("a merged feature " + *flaw);
}

void write(const MergedWall& wall, CArchive& out)
{
  out << wall.weight << wall.weighted_sum.x << wall.weighted_sum.y << wall.xx << wall.xy << wall.yy
      << wall.sightings;
  writeFeature(wall.line, out);
}

void read(CArchive& in, MergedWall& wall)
{
  in >> wall.weight >> wall.weighted_sum.x >> wall.weighted_sum.y >> wall.xx >> wall.xy >>
      wall.yy >> wall.sightings;
  wall.line = readFeature(in);
  if (!isSegment(wall.line.type) || !(wall.weight > 0) ||
      !areSums({wall.weight, wall.weighted_sum.x, wall.weighted_sum.y, wall.xx, wall.xy, wall.yy}))
  {
    throw BadContent("a merged wall of impossible sums");
  }
  requireOwn(wall.line);
  // Walls that are merged lie about the mean of their sums.
  const auto mean = wall.weighted_sum * (1.0 / wall.weight);
  if (!((mean - wall.line.position).norm() <= 0.5 * wall.line.size + 1))
    throw BadContent("a merged wall whose sums are of another place");
}

void write(const MergedPlace& place, CArchive& out)
{
  out << place.cosine_sum << place.sine_sum << place.count;
  writeFeature(place.feature, out);
}

void read(CArchive& in, MergedPlace& place)
{
  in >> place.cosine_sum >> place.sine_sum >> place.count;
  place.feature = readFeature(in);
  if (isSegment(place.feature.type) || place.count == 0 ||
      !areSums({place.cosine_sum, place.sine_sum}))
  {
    throw BadContent("a merged place of impossible sums");
  }
  requireOwn(place.feature);
}

const Feature& featureOf(const MergedWall& wall)
{
  return wall.line;
}

const Feature& featureOf(const MergedPlace& place)
{
  return place.feature;
}

template <class Item>
void writeAll(const std::vector<Item>& items, CArchive& out)
{
  out << static_cast<std::uint32_t>(items.size());
  for (const Item& item : items) write(item, out);
}

template <class Item>
std::vector<Item> readAll(CArchive& in)
{
  std::uint32_t count = 0;
  in >> count;
  std::vector<Item> items;
  double outline = 0;
  // Not resized at once: a damaged count must not allocate memory that the file has no data for.
  for (std::uint32_t i = 0; i < count; ++i)
  {
    items.emplace_back();
    read(in, items.back());
    outline += outlineLength(featureOf(items.back()));
    if (!(outline <= kLongestOutline)) throw BadContent("merged features that are too long");
  }
  return items;
}

// The counts of a tile as three planes: hits, passes, scans. Then the sums of the hits' positions.
constexpr std::size_t kCells = BeamCounts::kCellsOfTile;
using Planes = std::array<std::uint16_t, 3 * kCells>;
using Sums = std::array<std::int32_t, 2 * kCells>;

void writeTile(const CellIndex& name, const BeamCounts::Tile& tile, CArchive& out)
{
  Planes planes{};
  Sums sums{};
  for (std::size_t i = 0; i < kCells; ++i)
  {
    const BeamCounts::Count count = tile.count(i);
    planes[i] = count.hits;
    planes[kCells + i] = count.passes;
    planes[2 * kCells + i] = count.scans;
    sums[i] = count.sum_x;
    sums[kCells + i] = count.sum_y;
  }
  out << name.x << name.y;
  out.WriteBufferFixEndianness(planes.data(), planes.size());
  out.WriteBufferFixEndianness(sums.data(), sums.size());
}

BeamCounts::Tile readTile(CArchive& in, bool with_sums)
{
  Planes planes{};
  Sums sums{};
  in.ReadBufferFixEndianness(planes.data(), planes.size());
  if (with_sums) in.ReadBufferFixEndianness(sums.data(), sums.size());
  BeamCounts::Tile tile;
  for (std::size_t i = 0; i < kCells; ++i)
  {
    tile.set(i,
             {0, planes[i], planes[kCells + i], planes[2 * kCells + i], sums[i], sums[kCells + i]});
  }
  return tile;
}

void writeCounts(const BeamCounts& counts, CArchive& out)
{
  const BeamCounts::Extent& extent = counts.extent();
  out << extent.low.x << extent.low.y << extent.high.x << extent.high.y;
  const std::vector<CellIndex> names = counts.tileNames();
  out << static_cast<std::uint32_t>(names.size());
  for (const CellIndex& name : names) writeTile(name, counts.tile(name), out);
}

void readCounts(CArchive& in, BeamCounts& counts, bool with_sums)
{
  BeamCounts::Extent extent;
  in >> extent.low.x >> extent.low.y >> extent.high.x >> extent.high.y;
  std::uint32_t tiles = 0;
  in >> tiles;
  for (std::uint32_t i = 0; i < tiles; ++i)
  {
    CellIndex name;
    in >> name.x >> name.y;
    counts.restore(extent, name, readTile(in, with_sums));
  }
}
}  // namespace

void writeMapBuilder(const MapBuilder& builder, CArchive& out)
{
  out << kVersion;
  writeOptions(builder.options(), out);
  writeAll(builder.merger().walls(), out);
  writeAll(builder.merger().places(), out);
  writeCounts(builder.counts(), out);
}

MapBuilder readMapBuilder(CArchive& in, std::shared_ptr<const FeatureMap> base)
{
  std::uint8_t version = 0;
  in >> version;
  if (version > kVersion) throw BadContent("a map builder of a later version");
  const auto options = readOptions<MapBuildingOptions>(in);
  MapBuilder builder(options, std::move(base));
  auto walls = readAll<MergedWall>(in);
  auto places = readAll<MergedPlace>(in);
  BeamCounts counts = builder.counts();
  readCounts(in, counts, version != kVersionWithoutSums);
  builder.restore(FeatureMerger(options, std::move(walls), std::move(places)), std::move(counts));
  // Each may be sound and what they are merged to be beyond all bounds.
  if (auto flaw = flawOf(builder.features())) throw BadContent("merged features: " + *flaw);
  return builder;
}
}  // namespace sigloc::detail
