// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <cmath>

#include "eval/protocols/relocate.h"
#include "eval/reports/query_plots.h"
#include "eval/reports/report_files.h"
#include "eval/scoring/relocation_summary.h"

namespace sigloc
{
namespace
{
constexpr double kReferenceNsPerLookup = 3.4;

/// The methods' summaries, their times compared with the first one's.
std::vector<RelocationSummary> summariesOf(const RelocateReport& report)
{
  std::vector<RelocationSummary> summaries;
  for (const RelocateMethodReport& method : report.methods)
  {
    RelocationSummary& summary = summaries.emplace_back();
    summary.method = method.name;
    for (const RelocationRecord& record : method.records) summary.add(record);
    summary.reference_ms = medianTime(summaries.front());
  }
  return summaries;
}

std::string resultsCsv(const RelocateReport& report)
{
  std::string csv = "method," + csvHead(relocationColumns()) + "\n";
  for (const RelocateMethodReport& method : report.methods)
  {
    for (const RelocationRecord& record : method.records)
      csv += method.name + "," + csvRow(relocationColumns(), record) + "\n";
  }
  return csv;
}

std::string candidatesCsv(const RelocateReport& report)
{
  std::string csv = "method,query,view," + csvHead(candidateColumns()) + "\n";
  for (const RelocateMethodReport& method : report.methods)
  {
    for (const RelocationRecord& record : method.records)
    {
      for (const CandidateRecord& candidate : record.listed)
      {
        csv += fmt::format("{},{},{:.4f},{}\n", method.name, record.query, record.view,
                           csvRow(candidateColumns(), candidate));
      }
    }
  }
  return csv;
}

/// What the table does not say.
std::string remarks(const RelocateReport& report)
{
  std::string text;
  if (!report.complete)
    text += "**The rawlog is truncated: these are the steps that were read.**\n\n";
  if (report.foreign)
    text += "The queries are of another place: every confident answer is wrong.\n\n";
  if (report.without_truth > 0)
    text += fmt::format("{} steps without truth are left out.\n\n", report.without_truth);
  for (const RelocateMethodReport& method : report.methods)
  {
    const std::size_t cut_short = total(&RelocationRecord::cut_short)(method);
    if (cut_short > 0)
    {
      text += fmt::format(
          "* `{}`: cut short in {} of {} queries, which ended at the budget with the best found "
          "until then.\n",
          method.name, cut_short, method.records.size());
    }
    if (std::isnan(method.ns_per_lookup)) continue;
    text += fmt::format(
        "* `{}`: {:.2f} ns a look-up, everything included (the published figures of this search "
        "were taken at {:.1f} ns: ratios to it scale with this).\n",
        method.name, method.ns_per_lookup, kReferenceNsPerLookup);
  }
  return text;
}

std::vector<detail::QueryCurve> curvesOf(const RelocateReport& report)
{
  const auto error = [](const RelocationRecord& record) { return record.error.distance; };
  std::vector<detail::QueryCurve> curves;
  for (const RelocateMethodReport& method : report.methods)
  {
    curves.push_back(
        {method.name, values(error)(method), values(&RelocationRecord::time_ms)(method)});
  }
  return curves;
}
}  // namespace

std::string relocateTable(const RelocateReport& report)
{
  return markdownTable(table(summaryColumns(), summariesOf(report)));
}

void writeRelocateReport(const RelocateReport& report, const std::filesystem::path& folder)
{
  RunReport files;
  const std::vector<RelocationSummary> summaries = summariesOf(report);
  for (std::size_t i = 0; i < summaries.size(); ++i)
  {
    const RelocateMethodReport& method = report.methods[i];
    nlohmann::ordered_json& json = files.summary["methods"][method.name];
    json = toJson(summaryColumns(), summaries[i]);
    json["ns_per_lookup"] = method.ns_per_lookup;
    json["prepare_s"] = method.prepare_seconds;
    json["peak_rss_mb"] = method.peak_rss_mb;
  }
  files.summary["map"] = toJson(mapColumns(), report.map);
  files.summary["complete"] = report.complete;
  files.summary["without_truth"] = report.without_truth;
  files.results = resultsCsv(report);
  files.tables = {{"candidates.csv", candidatesCsv(report)}};
  files.text = "# Relocation from one scan\n\n" + relocateTable(report) + "\n" + remarks(report);
  files.plots = detail::queryPlots(curvesOf(report), "Time from raw scan to ranked candidates");
  files.notes = relocationDefinitions() + mapSection(report.map);
  files.provenance = report.provenance;
  writeRunReport(files, folder);
}
}  // namespace sigloc
