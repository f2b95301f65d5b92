// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/area_growth.h"

#include <memory>
#include <string>
#include <utility>

#include "eval/process/cpu_time.h"
#include "eval/protocols/GrowthMeter.h"
#include "eval/protocols/relocate.h"
#include "eval/worlds/buildings/buildings.h"

namespace sigloc::detail
{
namespace
{
// Offices as large as real ones, so that a scan sees as much of a large map as of a small one.
constexpr double kWidth = 48;  // [m]
constexpr double kHeight = 15;  // [m]
constexpr double kMapSpacing = 2;  // [m] between mapping scans
constexpr double kRangeSigma = 0.03;  // [m]

/// A map of offices and the queries in it.
struct Offices
{
  EvaluationMap map;
  std::vector<EvaluationQuery> queries;
  double area = 0;  ///< [m^2]
  double map_bytes = 0;
};

Offices makeOffices(std::uint32_t count, const ScaleOptions& options)
{
  WorldOptions layout;
  layout.width = kWidth;
  layout.height = kHeight;
  BuildingOptions buildings;
  buildings.buildings = count;
  LaserOptions laser;
  laser.range_sigma = kRangeSigma;
  const auto worlds = makeBuildings(WorldKind::office, layout, buildings, options.seed);
  Offices offices;
  offices.area = kWidth * kHeight * count;
  const auto scans = simulateMapping(worlds, kMapSpacing, kRobotClearance, laser, options.seed);
  const double bytes_before = heapBytes();
  const double start = threadCpuSeconds();
  offices.map.features = std::make_shared<const FeatureMap>(buildMapFromScans(scans));
  offices.map.build_seconds = threadCpuSeconds() - start;
  offices.map_bytes = heapBytes() - bytes_before;
  const auto asked = static_cast<std::uint32_t>(options.poses);
  for (PosedScans& query : simulateQueries(worlds, asked, kRobotClearance, laser, options.seed))
  {
    offices.queries.push_back(
        {std::to_string(offices.queries.size()), std::move(query.scans), query.map_from_robot});
  }
  return offices;
}

ScaleRow runRow(const std::string& name, const Offices& offices, const ScaleOptions& options)
{
  ScaleRow row;
  row.method = name;
  row.map_features = offices.map.features->features().size();
  row.observed = ScaleRow::kNone;  // the scan is what is seen
  row.area = offices.area;
  row.map_seconds = offices.map.build_seconds;
  RelocationMethodOptions method_options;
  method_options.seed = static_cast<std::uint32_t>(options.seed);
  const double bytes_before = heapBytes();
  const double start = threadCpuSeconds();
  const auto method = makeRelocationMethod(name, offices.map, method_options);
  row.build_seconds = threadCpuSeconds() - start;
  const double bytes = offices.map_bytes + heapBytes() - bytes_before;
  row.bytes_per_feature = bytes / static_cast<double>(row.map_features);
  row.bytes_per_m2 = bytes / row.area;
  RelocationSummary outcomes;
  for (const RelocationRecord& record :
       askQueries(*method, offices.queries, simulationGates(), 1, name, {}))
  {
    outcomes.add(record);
  }
  row.records = std::move(outcomes.records);
  return row;
}
}  // namespace

ScaleReport runAreaGrowth(const ScaleOptions& options)
{
  checkRelocationMethods(options.methods);
  ScaleReport report;
  report.where = " with the mapped area";
  report.provenance.command = options.command;
  report.provenance.seed = options.seed;
  for (const std::uint32_t count : options.buildings)
  {
    const Offices offices = makeOffices(count, options);
    report.map.add(*offices.map.features, offices.map.build_seconds);
    for (const std::string& name : options.methods)
    {
      report.rows.push_back(runRow(name, offices, options));
      if (options.progress) options.progress(progressLine(report.rows.back()));
    }
  }
  return report;
}
}  // namespace sigloc::detail
