// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <mrpt/core/bits_math.h>

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
    const std::size_t by_pairs = total(&RelocationRecord::settled_by_pairs)(method);
    if (by_pairs > 0)
    {
      text += fmt::format(
          "* `{}`: pairs of key points settled {} of {} queries, without any minimal set.\n",
          method.name, by_pairs, method.records.size());
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
PagePlace pagePlace(const std::string& method, const RelocationRecord& record)
{
  PagePlace place;
  place.method = method;
  place.name = "query " + record.query;
  const bool right = record.rank_of_right == 1;
  place.outcome = record.sawNothing() ? PageOutcome::saw_nothing : pageOutcome(right, record.claim);
  place.truth = record.truth;
  place.first = record.first;
  const auto fact = [&](const std::string& name, const std::string& text)
  { place.facts.emplace_back(name, text); };
  fact("verdict", toString(record.verdict));
  fact("probability of the verdict", probabilityText(record.probability));
  if (!record.listed.empty())
  {
    fact("probability of the first pose",
         probabilityText(record.listed.front().candidate.probability));
  }
  if (record.truth && record.first)
  {
    fact("off the truth", fmt::format("{:.2f} m, {:.1f} deg", record.error.distance,
                                      mrpt::RAD2DEG(record.error.angle)));
  }
  fact("rank of the right pose",
       record.rank_of_right > 0 ? std::to_string(record.rank_of_right) : "none");
  fact("candidates", std::to_string(record.candidates));
  fact("valid beams", std::to_string(record.valid_beams));
  fact("time", fmt::format("{:.2f} ms", record.time_ms));
  return place;
}

PageMap pageOf(const RelocateReport& report)
{
  PageMap page;
  page.map = report.features;
  for (const RelocateMethodReport& method : report.methods)
  {
    for (const RelocationRecord& record : method.records)
      page.places.push_back(pagePlace(method.name, record));
  }
  return page;
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
  files.page = pageOf(report);
  files.provenance = report.provenance;
  writeRunReport(files, folder);
}
}  // namespace sigloc
