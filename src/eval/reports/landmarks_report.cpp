// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

#include "config/fixed_number.h"
#include "config/TextStream.h"
#include "eval/process/cpu_time.h"
#include "eval/protocols/landmarks.h"
#include "eval/reports/query_plots.h"
#include "eval/reports/relocation_rows.h"
#include "eval/reports/report_files.h"
#include "sigloc/config/plural.h"

namespace sigloc
{
namespace
{
constexpr const char* kExplanation =
    "\nFirm: significant, and far ahead of the second. Not judged: answers that are not right by a "
    "truth that is\nuncertain by more than 0.5 m itself, or jumps against the odometry; they count "
    "as "
    "not right, but not as wrong.\n";

/// What every sub-command's summary tells, of all queries of a method: confident is firm.
RelocationSummary pooled(const LandmarksReport& report, const std::string& method)
{
  RelocationSummary s;
  std::vector<double> times;
  std::vector<double> distances;
  std::vector<double> angles;
  s.claims_verdict = true;
  for (const LandmarkRecord& record : report.records)
  {
    if (record.method != method) continue;
    ++s.queries;
    ++s.recall_at_1.cases;
    s.saw_nothing += record.features == 0;
    s.confident += record.firm;
    s.confident_right += record.firm && record.right;
    s.confidently_wrong += record.firm && !record.right && record.truth_sure;
    s.cut_short += record.cut_short;
    s.recall_at_1.count += record.right;
    times.push_back(record.time_ms);
    if (!record.right) continue;
    distances.push_back(record.error.distance);
    angles.push_back(record.error.angle_deg);
  }
  s.time_ms = quantilesOf(times);
  s.median_error_m = quantilesOf(distances).median;
  s.median_error_deg = quantilesOf(angles).median;
  return s;
}
/// One curve a method and length of the local maps.
std::vector<detail::LookCurve> curvesOf(const LandmarksReport& report)
{
  std::vector<detail::LookCurve> curves;
  for (const LandmarksRow& row : report.rows)
  {
    detail::LookCurve& curve = curves.emplace_back();
    curve.title = row.method;
    if (row.local_map_steps > 0) curve.title += ", " + counted(row.local_map_steps, "step");
    for (const LandmarkRecord& record : report.records)
    {
      if (record.method != row.method || record.local_map_steps != row.local_map_steps) continue;
      curve.errors_m.push_back(record.error.distance);
      curve.times_ms.push_back(record.time_ms);
    }
  }
  return curves;
}
}  // namespace

std::string landmarksTable(const LandmarksReport& report)
{
  std::vector<std::vector<std::string>> rows{
      {"method", "local map steps", "features", "right", "firm", "firm and wrong", "not judged",
       "travel m median", "p95", "ms median", "p95", "mean", "operations", "cut short"}};
  for (const LandmarksRow& row : report.rows)
  {
    rows.push_back({row.method,
                    row.local_map_steps > 0 ? std::to_string(row.local_map_steps) : "as needed",
                    fixedNumber(row.features, 1), withInterval(row.right), withInterval(row.firm),
                    withInterval(row.firm_and_wrong), std::to_string(row.not_judged),
                    fixedNumber(row.travelled.median, 2), fixedNumber(row.travelled.p95, 2),
                    fixedNumber(row.time_ms.median, 3), fixedNumber(row.time_ms.p95, 3),
                    fixedNumber(row.time_ms.mean, 3), fixedNumber(row.operations, 0),
                    std::to_string(row.cut_short)});
  }
  return markdownTable(rows);
}

void writeLandmarksReport(const LandmarksReport& report, const std::filesystem::path& folder)
{
  RunReport files;
  TextStream csv;
  csv << "method,local_map_steps,step,features,travelled_m,answered,firm,right,truth_sure,error_m,"
         "error_deg,"
         "operations,time_ms\n";
  for (const LandmarkRecord& r : report.records)
  {
    csv << r.method << ',' << r.local_map_steps << ',' << r.step << ',' << r.features << ','
        << fixedNumber(r.travelled, 3) << ',' << r.answered << ',' << r.firm << ',' << r.right
        << ',' << r.truth_sure << ',' << fixedNumber(r.error.distance, 3) << ','
        << fixedNumber(r.error.angle_deg, 3) << ',' << r.operations << ','
        << fixedNumber(r.time_ms, 4) << '\n';
  }
  nlohmann::ordered_json& json = files.summary;
  for (const LandmarksRow& row : report.rows)
  {
    json["methods"][row.method] = toJson(pooled(report, row.method));
    json["methods"][row.method]["peak_rss_mb"] = peakMemoryMb();
  }
  for (const LandmarksRow& row : report.rows)
  {
    nlohmann::ordered_json entry;
    entry["local_map_steps"] = row.local_map_steps;
    entry["queries"] = row.right.cases;
    addProportion(entry, "recall_at_1", row.right);
    addProportion(entry, "firm", row.firm);
    addProportion(entry, "firm_and_wrong", row.firm_and_wrong);
    entry["not_judged"] = row.not_judged;
    entry["travelled_m"] = toJson(row.travelled);
    entry["time_ms"] = toJson(row.time_ms);
    entry["operations"] = row.operations;
    entry["cut_short"] = row.cut_short;
    json["methods"][row.method]["rows"].push_back(entry);
  }
  json["map"] = toJson(report.map);
  files.results = csv.str();
  files.text = "# Landmarks: " + report.dataset + "\n\n" + landmarksTable(report) + kExplanation;
  files.plots = detail::lookPlots(curvesOf(report), "Time from landmarks to ranked candidates");
  files.notes = mapSection(report.map);
  files.provenance = report.provenance;
  writeRunReport(files, folder);
}
}  // namespace sigloc
