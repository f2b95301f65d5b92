// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/relocate.h"

#include <limits>
#include <stdexcept>

#include "eval/data/method_names.h"
#include "eval/process/cpu_time.h"

namespace sigloc
{
namespace
{
double nsPerLookup(const RelocationMethod& method, const std::vector<RelocationRecord>& records)
{
  double lookups = 0;
  double milliseconds = 0;
  for (const RelocationRecord& record : records)
  {
    lookups += static_cast<double>(record.poses_scored) * method.lookupsPerPose();
    milliseconds += record.time_ms;
  }
  return lookups > 0 ? 1e6 * milliseconds / lookups : std::numeric_limits<double>::quiet_NaN();
}

RelocateMethodReport runMethod(const std::string& name, const EvaluationData& data,
                               const RelocateOptions& options)
{
  RelocateMethodReport report;
  report.name = name;
  resetPeakMemory();
  const double before = threadCpuSeconds();
  const auto method = makeRelocationMethod(name, data.map, options.method);
  report.prepare_seconds = threadCpuSeconds() - before;
  report.records =
      askQueries(*method, data.queries, options.gates, options.threads, name, options.progress);
  report.ns_per_lookup = nsPerLookup(*method, report.records);
  report.peak_rss_mb = peakMemoryMb();
  report.failures =
      collectFailures(name, *method, data.map, data.queries, report.records, options.keep_failures);
  return report;
}

/// Recorded scans, or scans simulated in the map.
EvaluationData readData(const RelocateOptions& options)
{
  const EvaluationSources& sources = options.sources;
  if (options.scans_in_map.count == 0) return readEvaluationData(sources);
  if (!sources.queries.empty() || !sources.rawlog.empty() || sources.interleave > 0 ||
      sources.foreign)
  {
    throw std::invalid_argument("--scans-in-map asks no recorded scans");
  }
  EvaluationData data;
  data.map = readEvaluationMap(sources.map, sources.reading);
  data.queries = scansInMap(data.map, options.scans_in_map);
  return data;
}
}  // namespace

std::vector<RelocationRecord> askQueries(const RelocationMethod& method,
                                         const std::vector<EvaluationQuery>& queries,
                                         const AccuracyGates& gates, std::uint32_t threads,
                                         const std::string& what, const ShowProgress& progress)
{
  std::vector<RelocationResult> answers(queries.size());
  std::vector<double> times(queries.size());
  std::vector<RelocationRecord> records(queries.size());
  const auto ask = [&](std::size_t i)
  {
    const double start = threadCpuSeconds();
    answers[i] = method.localize(queries[i].scans);
    times[i] = 1e3 * (threadCpuSeconds() - start);
  };
  // After all are answered: a million proposals that are listed leave cold caches.
  const auto judge = [&](std::size_t i)
  {
    records[i] = judgeRelocation(queries[i], answers[i], method.claimsVerdict(),
                                 method.propose(queries[i].scans), gates);
    records[i].time_ms = times[i];
    answers[i] = {};
  };
  const auto half_after = [&](double before)
  {
    return [&progress, before](const std::string& name, double share)
    {
      if (progress) progress(name, before + share / 2);
    };
  };
  runParallel(queries.size(), threads, ask, what, half_after(0));
  runParallel(queries.size(), threads, judge, what, half_after(0.5));
  return records;
}

void checkRelocationMethods(const std::vector<std::string>& names)
{
  checkMethodNames(names, relocationMethodNames());
}

RelocateReport runRelocate(const RelocateOptions& options)
{
  checkRelocationMethods(options.methods);
  RelocateReport report;
  report.provenance.command = options.command;
  report.provenance.seed = options.method.seed;
  for (const auto& path : {options.sources.map, options.sources.queries, options.sources.rawlog,
                           options.sources.ground_truth})
  {
    if (!path.empty()) report.provenance.data_files.push_back(path);
  }
  const EvaluationData data = readData(options);
  report.map.add(*data.map.features, data.map.build_seconds);
  report.features = data.map.features;
  report.without_truth = data.without_truth;
  report.complete = data.complete;
  report.foreign = options.sources.foreign;
  for (const std::string& name : options.methods)
  {
    report.methods.push_back(runMethod(name, data, options));
  }
  return report;
}
}  // namespace sigloc
