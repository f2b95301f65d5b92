// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/scoring/map_statistics.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <nlohmann/json.hpp>

#include "config/fixed_number.h"
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

nlohmann::ordered_json toJson(const MapStatistics& statistics)
{
  return {{"maps", statistics.maps},
          {"features", statistics.features},
          {"build_s", statistics.build_seconds},
          {"bytes", statistics.bytes}};
}

std::string mapSection(const MapStatistics& statistics)
{
  return "\n## Map\n\n" +
         (statistics.maps > 1
              ? "* maps, of which these are sums: " + std::to_string(statistics.maps) + "\n"
              : std::string()) +
         "* features: " + std::to_string(statistics.features) +
         "\n* bytes, serialized: " + std::to_string(statistics.bytes) +
         "\n* built in [s]: " + fixedNumber(statistics.build_seconds, 3) + "\n";
}
}  // namespace sigloc
