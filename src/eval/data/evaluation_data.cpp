// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/data/evaluation_data.h"

#include <stdexcept>

#include "eval/process/cpu_time.h"
#include "io/GroundTruth.h"
#include "map/map_values.h"
#include "sigloc/io/map_files.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc
{
namespace
{
// Fixed for the reference search. A cell hit once is wall: otherwise areas that few scans saw are
// lost (aces revisit: recall@1 0.86 instead of 1.00).
constexpr double kSearchResolution = 0.1;  // [m]
constexpr std::uint32_t kSearchMinHits = 1;

/// Whether the baselines can search the map: a frame in tiles may be too large for a raster.
bool isSearchable(const FeatureMap& map)
{
  return map.field() && !flawOf(map.field()->frame);
}

EvaluationMap evaluationMapOf(const MapSource& source)
{
  if (const auto* scans = std::get_if<std::vector<PosedScans>>(&source))
  {
    return evaluationMapFromScans(*scans);
  }
  EvaluationMap map;
  if (const auto* raster = std::get_if<OccupancyRaster>(&source))
  {
    const double start = threadCpuSeconds();
    map.features = std::make_shared<const FeatureMap>(buildMapFromRaster(*raster));
    map.build_seconds = threadCpuSeconds() - start;
    map.raster = *raster;
    return map;
  }
  const auto& features = std::get<FeatureMap>(source);
  map.features = std::make_shared<const FeatureMap>(features);
  if (isSearchable(features)) map.raster = rasterOf(*features.field());
  return map;
}

void requireFeatures(const EvaluationMap& map, const std::filesystem::path& path)
{
  if (map.features->empty()) throw std::runtime_error(path.string() + ": no feature found in it");
}

std::vector<PosedScans> scansOf(MapSource source, const std::filesystem::path& path)
{
  auto* scans = std::get_if<std::vector<PosedScans>>(&source);
  if (!scans) throw std::runtime_error(path.string() + ": holds no scans with poses");
  return std::move(*scans);
}

std::vector<EvaluationQuery> queriesOf(const std::vector<PosedScans>& posed,
                                       const EvaluationSources& sources)
{
  std::vector<EvaluationQuery> queries;
  for (std::size_t i = 0; i < posed.size(); ++i)
  {
    EvaluationQuery query;
    query.name = std::to_string(i);
    query.scans = posed[i].scans;
    if (!sources.foreign) query.truth = sources.map_from_queries + posed[i].map_from_robot;
    queries.push_back(std::move(query));
  }
  return queries;
}

void readRawlogQueries(const EvaluationSources& sources, EvaluationData& data)
{
  std::optional<GroundTruth> truth;
  if (!sources.foreign)
  {
    if (sources.ground_truth.empty())
    {
      throw std::invalid_argument("--rawlog needs --ground-truth (or --foreign)");
    }
    truth = GroundTruth::read(sources.ground_truth, sources.map_from_queries);
  }
  RawlogReader reader(sources.rawlog, sources.reading);
  for (std::size_t step = 0; auto read = reader.next(); ++step)
  {
    if (read->scans.empty()) continue;
    EvaluationQuery query;
    query.name = std::to_string(step);
    query.scans = std::move(read->scans);
    if (truth)
    {
      query.truth = truth->at(step, read->time);
      if (!query.truth)
      {
        ++data.without_truth;
        continue;
      }
    }
    data.queries.push_back(std::move(query));
  }
  data.complete = !reader.truncated();
}

void checkSources(const EvaluationSources& sources)
{
  const int kinds = (sources.queries.empty() ? 0 : 1) + (sources.rawlog.empty() ? 0 : 1) +
                    (sources.interleave > 0 ? 1 : 0);
  if (kinds != 1)
  {
    throw std::invalid_argument("give exactly one of --queries, --rawlog and --interleave");
  }
  if (!sources.ground_truth.empty() && (sources.rawlog.empty() || sources.foreign))
  {
    throw std::invalid_argument(sources.foreign
                                    ? "--ground-truth: of a foreign place no truth is read"
                                    : "--ground-truth needs --rawlog: key frames bring their own");
  }
  if (sources.map_from_queries != mrpt::math::TPose2D() &&
      (sources.interleave > 0 || sources.foreign))
  {
    throw std::invalid_argument("--map-from-queries needs queries of this place from another file");
  }
  if (sources.foreign && sources.interleave > 0)
  {
    throw std::invalid_argument("--foreign: scans taken out of the map are of the same place");
  }
  if (sources.interleave == 1)
  {
    throw std::invalid_argument("--interleave 1 leaves no scan for the map");
  }
}
}  // namespace

std::vector<std::size_t> evenlySpaced(std::size_t size, std::size_t count)
{
  if (count == 0 || count > size) count = size;
  std::vector<std::size_t> indices;
  indices.reserve(count);
  for (std::size_t i = 0; i < count; ++i) indices.push_back(i * size / count);
  return indices;
}

EvaluationMap evaluationMapFromScans(const std::vector<PosedScans>& scans)
{
  EvaluationMap map;
  const double start = threadCpuSeconds();
  map.features = std::make_shared<const FeatureMap>(buildMapFromScans(scans));
  map.build_seconds = threadCpuSeconds() - start;
  MapBuildingOptions options;
  options.raster_resolution = kSearchResolution;
  options.min_hits = kSearchMinHits;
  if (isSearchable(*map.features)) map.raster = rasterFromScans(scans, options);
  for (const PosedScans& posed : scans) map.mapped_poses.push_back(posed.map_from_robot);
  return map;
}

EvaluationMap readEvaluationMap(const std::filesystem::path& path, const ReadingOptions& reading)
{
  try
  {
    EvaluationMap map = evaluationMapOf(readMapSource(path, reading));
    requireFeatures(map, path);
    map.file = path;
    return map;
  }
  catch (const std::invalid_argument& error)
  {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

EvaluationData readEvaluationData(const EvaluationSources& sources)
{
  checkSources(sources);
  EvaluationData data;
  if (sources.interleave > 0)
  {
    const std::vector<PosedScans> all =
        scansOf(readMapSource(sources.map, sources.reading), sources.map);
    std::vector<PosedScans> mapped;
    std::vector<PosedScans> asked;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      (i % sources.interleave == sources.interleave - 1 ? asked : mapped).push_back(all[i]);
    }
    data.map = evaluationMapFromScans(mapped);
    requireFeatures(data.map, sources.map);
    data.queries = queriesOf(asked, sources);
  }
  else
  {
    data.map = readEvaluationMap(sources.map, sources.reading);
    if (sources.rawlog.empty())
    {
      data.queries = queriesOf(
          scansOf(readMapSource(sources.queries, sources.reading), sources.queries), sources);
    }
    else
    {
      readRawlogQueries(sources, data);
    }
  }
  std::vector<EvaluationQuery> kept;
  for (const std::size_t i : evenlySpaced(data.queries.size(), sources.max_queries))
  {
    kept.push_back(std::move(data.queries[i]));
  }
  data.queries = std::move(kept);
  if (data.queries.empty())
  {
    const auto& path = !sources.queries.empty()  ? sources.queries
                       : !sources.rawlog.empty() ? sources.rawlog
                                                 : sources.map;
    throw std::runtime_error(path.string() + ": holds no scan with truth to ask for");
  }
  return data;
}
}  // namespace sigloc
