// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/scoring/map_statistics.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include "sigloc/io/map_files.h"

namespace sigloc
{
namespace
{
std::size_t serializedBytes(const FeatureMap& map)
{
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  writeFeatureMap(map, archive);
  return static_cast<std::size_t>(stream.getTotalBytesCount());
}
}  // namespace

void MapStatistics::add(const FeatureMap& map, double seconds)
{
  ++maps;
  features += map.features().size();
  bytes += serializedBytes(map);
  build_seconds += seconds;
}

Columns<MapStatistics> mapColumns()
{
  using M = MapStatistics;
  using C = Column<M>;
  return {C("maps", &M::maps), C("features", &M::features, "", 0, {"features"}),
          C("build_s", &M::build_seconds, "", 3, {"built in [s]"}, 1),
          C("bytes", &M::bytes, "", 0, {"bytes, serialized"})};
}

std::string mapSection(const MapStatistics& statistics)
{
  std::string text = "\n## Map\n\n";
  if (statistics.maps > 1)
    text += "* maps, of which these are sums: " + std::to_string(statistics.maps) + "\n";
  const Cells heads = tableHead(mapColumns());
  const Cells cells = tableRow(mapColumns(), statistics);
  for (std::size_t i = 0; i < heads.size(); ++i) text += "* " + heads[i] + ": " + cells[i] + "\n";
  return text;
}
}  // namespace sigloc
