// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/bits_math.h>

#include "eval/process/cpu_time.h"
#include "eval/protocols/landmarks.h"
#include "eval/reports/query_plots.h"
#include "eval/reports/report_files.h"
#include "eval/scoring/relocation_summary.h"
#include "sigloc/config/plural.h"

namespace sigloc
{
namespace
{
/// All queries of one method with local maps of one length.
struct LandmarksRow
{
  std::string method;
  std::size_t local_map_steps;  ///< 0: as many as needed
  std::vector<LandmarkRecord> records;
};

std::vector<LandmarksRow> rowsOf(const LandmarksReport& report)
{
  std::vector<LandmarksRow> rows;
  for (const LandmarkRecord& record : report.records)
  {
    if (rows.empty() || rows.back().method != record.method ||
        rows.back().local_map_steps != record.local_map_steps)
      rows.push_back({record.method, record.local_map_steps, {}});
    rows.back().records.push_back(record);
  }
  return rows;
}

std::string stepsText(const LandmarksRow& row)
{
  return row.local_map_steps > 0 ? std::to_string(row.local_map_steps) : "as needed";
}

Columns<LandmarksRow> landmarksColumns()
{
  using C = Column<LandmarksRow>;
  using R = LandmarkRecord;
  return {
      C("", &LandmarksRow::method, "", 0, {"method"}),
      C("local_map_steps", &LandmarksRow::local_map_steps),
      C("", stepsText, "", 0, {"local map steps"}),
      C("", part(&Quantiles::mean, quantiles(&R::features)), "", 1, {"features"}),
      C("queries", [](const LandmarksRow& row) { return row.records.size(); }),
      C("recall_at_1", share(&R::right), "", 0, {"right"}),
      C("firm", share(&R::confident), "significant, and far ahead of the second", 0, {"firm"}),
      C("firm_and_wrong", share(&R::confidently_wrong), "", 0, {"firm and wrong"}),
      C("not_judged", total([](const R& record) { return !*record.right && !record.truth_sure; }),
        "answers that are not right by a truth that is uncertain by more than 0.5 m itself, or "
        "jumps against the odometry; they count as not right, but not as wrong",
        0, {"not judged"}),
      C("travelled_m", quantiles(&R::travelled), "", 2, {"travel m median", "p95"}),
      C("time_ms", quantiles(&R::times_ms), "", 3, {"ms median", "p95", "mean"}),
      C("operations", part(&Quantiles::mean, quantiles(&R::operations)), "", 0, {"operations"}),
      C("cut_short", total(&R::cut_short), "", 0, {"cut short"})};
}

Columns<LandmarkRecord> recordColumns()
{
  using R = LandmarkRecord;
  using C = Column<R>;
  return {C("method", &R::method),
          C("local_map_steps", &R::local_map_steps),
          C("step", &R::step),
          C("features", &R::features),
          C("travelled_m", &R::travelled),
          C("answered", &R::answered),
          C("firm", &R::confident),
          C("right", &R::right),
          C("truth_sure", &R::truth_sure),
          C("error_m", [](const R& r) { return r.first_error.distance; }),
          C("error_deg", [](const R& r) { return mrpt::RAD2DEG(r.first_error.angle); }),
          C("operations", &R::operations),
          C(
              "time_ms", [](const R& r) { return r.times_ms.front(); }, "", 4)};
}

/// One curve a method and length of the local maps.
std::vector<detail::QueryCurve> curvesOf(const LandmarksReport& report)
{
  const auto error = [](const LandmarkRecord& record) { return record.first_error.distance; };
  std::vector<detail::QueryCurve> curves;
  for (const LandmarksRow& row : rowsOf(report))
  {
    curves.push_back({row.method, values(error)(row), values(&LandmarkRecord::times_ms)(row)});
    if (row.local_map_steps > 0) curves.back().title += ", " + counted(row.local_map_steps, "step");
  }
  return curves;
}
}  // namespace

std::string landmarksTable(const LandmarksReport& report)
{
  return markdownTable(table(landmarksColumns(), rowsOf(report)));
}

void writeLandmarksReport(const LandmarksReport& report, const std::filesystem::path& folder)
{
  RunReport files;
  nlohmann::ordered_json& json = files.summary;
  json["methods"] = methodsJson(rowsOf(report), landmarksColumns(), peakMemoryMb());
  json["map"] = toJson(mapColumns(), report.map);
  files.results = csvFile(recordColumns(), report.records);
  files.text = "# Landmarks: " + report.dataset + "\n\n" + landmarksTable(report);
  files.plots = detail::queryPlots(curvesOf(report), "Time from landmarks to ranked candidates");
  files.notes = legend("What the columns mean", landmarksColumns()) + mapSection(report.map);
  files.provenance = report.provenance;
  writeRunReport(files, folder);
}
}  // namespace sigloc
