// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "config/fixed_number.h"
#include "config/TextStream.h"
#include "eval/protocols/relocate.h"
#include "eval/reports/query_plots.h"
#include "eval/reports/relocation_rows.h"
#include "eval/reports/report_files.h"

namespace sigloc
{
namespace
{
constexpr double kReferenceNsPerLookup = 3.4;

nlohmann::ordered_json methodJson(const RelocateMethodReport& method)
{
  nlohmann::ordered_json json = toJson(method.summary);
  json["ns_per_lookup"] = method.summary.ns_per_lookup;
  json["prepare_s"] = method.prepare_seconds;
  json["peak_rss_mb"] = method.summary.peak_rss_mb;
  return json;
}

std::string resultsCsv(const RelocateReport& report)
{
  std::string csv = relocationCsvHead() + "\n";
  for (const RelocateMethodReport& method : report.methods)
  {
    for (const RelocationRecord& record : method.records)
    {
      csv += relocationCsvRow(method.name, record) + "\n";
    }
  }
  return csv;
}

/// What the table does not say.
std::string remarks(const RelocateReport& report)
{
  TextStream out;
  if (!report.complete)
    out << "**The rawlog is truncated: these are the steps that were read.**\n\n";
  if (report.foreign)
    out << "The queries are of another place: every confident answer is wrong.\n\n";
  if (report.without_truth > 0)
  {
    out << report.without_truth << " steps without truth are left out.\n\n";
  }
  for (const RelocateMethodReport& method : report.methods)
  {
    if (method.summary.cut_short > 0)
    {
      out << "* `" << method.name << "`: cut short in " << method.summary.cut_short << " of "
          << method.summary.queries
          << " queries, which ended at the budget with the best found until then.\n";
    }
    if (std::isnan(method.summary.ns_per_lookup)) continue;
    out << "* `" << method.name << "`: " << fixedNumber(method.summary.ns_per_lookup, 2)
        << " ns a look-up, everything included (the published figures of this search were taken at "
        << fixedNumber(kReferenceNsPerLookup, 1) << " ns: ratios to it scale with this).\n";
  }
  return out.str();
}

std::vector<detail::LookCurve> curvesOf(const RelocateReport& report)
{
  std::vector<detail::LookCurve> curves;
  for (const RelocateMethodReport& method : report.methods)
  {
    detail::LookCurve& curve = curves.emplace_back();
    curve.title = method.name;
    for (const RelocationRecord& record : method.records)
    {
      curve.errors_m.push_back(record.error.distance);
      curve.times_ms.push_back(record.time_ms);
    }
  }
  return curves;
}
}  // namespace

std::string relocateTable(const RelocateReport& report)
{
  std::vector<std::vector<std::string>> rows = {relocationTableHead()};
  for (const RelocateMethodReport& method : report.methods)
  {
    rows.push_back(relocationTableRow(method.name, method.summary, report.methods.front().summary));
  }
  return markdownTable(rows);
}

void writeRelocateReport(const RelocateReport& report, const std::filesystem::path& folder)
{
  RunReport files;
  for (const RelocateMethodReport& method : report.methods)
  {
    files.summary["methods"][method.name] = methodJson(method);
  }
  files.summary["map"] = toJson(report.map);
  files.summary["complete"] = report.complete;
  files.summary["without_truth"] = report.without_truth;
  files.results = resultsCsv(report);
  files.text = "# Relocation from one look\n\n" + relocateTable(report) + "\n" + remarks(report);
  files.plots = detail::lookPlots(curvesOf(report), "Time from raw scan to ranked candidates");
  files.notes = relocationDefinitions() + mapSection(report.map);
  files.provenance = report.provenance;
  writeRunReport(files, folder);
}
}  // namespace sigloc
