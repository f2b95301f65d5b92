// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/map_extension.h"

#include <memory>
#include <stdexcept>

#include "map/building/MapBuilder.h"

namespace sigloc
{
FeatureMap extendMap(const FeatureMap& map, const std::vector<PosedScans>& scans,
                     const MapBuildingOptions& options, const FeatureExtractorOptions& extraction)
{
  MapBuilder builder(options, std::make_shared<FeatureMap>(map));
  for (const PosedScans& posed : scans) builder.add(posed, extraction);
  if (builder.empty()) throw std::invalid_argument("extendMap: no scan has a valid return");
  return builder.map();
}
}  // namespace sigloc
