// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>
#include <sstream>

#include "sigloc/eval/plot.h"
#include "sigloc/eval/relocate.h"
#include "sigloc/eval/report_files.h"

namespace sigloc
{
namespace
{
constexpr double kReferenceNsPerLookup = 3.4;

constexpr const char* kDefinitions = R"(
## What the columns mean

* **recall@1**: the first candidate lies within 0.5 m and 10 degrees of the truth; **tight**: within
  0.5 m and 3.6 degrees; **recall@10**: one of the first ten does. **proposed**: a right pose was
  among those that the method's features proposed; empty for methods that search instead.
* **confident**: the verdict is `localized`, P(first) >= 0.99. Of these, **right** as above,
  **wrong**: more than 1 m or 20 degrees off (in a foreign map: every one), **inaccurate**: between.
  Methods without a verdict show `-`.
* **error**: median over right first answers.
* **time**: CPU time of one thread from raw scan to ranked candidates, feature extraction included.
  **ratio**: median time over that of the first method listed.
* Shares are over queries that saw something (10 valid beams or more) and carry Wilson 95 % intervals.
)";

nlohmann::ordered_json methodJson(const RelocateMethodReport& method)
{
  const RelocationSummary& s = method.summary;
  nlohmann::ordered_json json;
  json["queries"] = s.queries;
  json["saw_nothing"] = s.saw_nothing;
  json["claims_verdict"] = s.claims_verdict;
  json["confident"] = s.confident;
  json["confident_right"] = s.confident_right;
  json["confidently_wrong"] = s.confidently_wrong;
  json["inaccurate"] = s.inaccurate;
  addProportion(json, "recall_at_1", s.recall_at_1);
  addProportion(json, "recall_at_1_tight", s.recall_at_1_tight);
  addProportion(json, "recall_at_10", s.recall_at_10);
  addProportion(json, "proposed", s.proposed);
  json["median_error_m"] = s.median_error_m;
  json["median_error_deg"] = s.median_error_deg;
  json["poses_scored"] = toJson(s.poses_scored);
  json["proposals"] = toJson(s.proposals);
  json["time_ms"] = toJson(s.time_ms);
  json["ns_per_lookup"] = s.ns_per_lookup;
  json["prepare_s"] = method.prepare_seconds;
  json["peak_rss_mb"] = s.peak_rss_mb;
  return json;
}

std::string poseCells(const std::optional<mrpt::math::TPose2D>& pose)
{
  if (!pose) return ",,";
  return fixedNumber(pose->x, 4) + "," + fixedNumber(pose->y, 4) + "," + fixedNumber(pose->phi, 5);
}

std::string resultsCsv(const RelocateReport& report)
{
  std::ostringstream csv;
  csv << "method,query,truth_x,truth_y,truth_phi,valid_beams,verdict,probability,x,y,phi,score,"
         "error_m,error_deg,candidates,rank_of_right,proposals,proposed,claim,poses_scored,"
         "time_ms\n";
  for (const RelocateMethodReport& method : report.methods)
  {
    for (const RelocationRecord& r : method.records)
    {
      csv << method.name << "," << r.query << "," << poseCells(r.truth) << "," << r.valid_beams
          << "," << toString(r.verdict) << "," << fixedNumber(r.probability, 6) << ","
          << poseCells(r.first) << "," << fixedNumber(r.first_score, 5) << ","
          << fixedNumber(r.error.distance, 4) << "," << fixedNumber(r.error.angle_deg, 3) << ","
          << r.candidates << "," << r.rank_of_right << "," << r.proposals << ","
          << (r.proposed ? (*r.proposed ? "1" : "0") : "") << "," << toString(r.claim) << ","
          << r.poses_scored << "," << fixedNumber(r.time_ms, 3) << "\n";
    }
  }
  return csv.str();
}

std::vector<std::vector<std::string>> tableRows(const RelocateReport& report)
{
  std::vector<std::vector<std::string>> rows = {{"method", "queries", "saw nothing", "recall@1",
                                                 "tight", "recall@10", "proposed", "confident",
                                                 "right", "wrong", "inaccurate", "error m",
                                                 "error deg", "ms median", "p95", "mean", "ratio"}};
  for (const RelocateMethodReport& method : report.methods)
  {
    const RelocationSummary& s = method.summary;
    const auto claims = [&](std::size_t count)
    { return s.claims_verdict ? std::to_string(count) : std::string("-"); };
    const auto share = [](const Proportion& p)
    { return p.cases > 0 ? fixedNumber(p.value(), 3) : std::string("-"); };
    const double ratio = s.time_ms.median / report.methods.front().summary.time_ms.median;
    rows.push_back({method.name, std::to_string(s.queries), std::to_string(s.saw_nothing),
                    withInterval(s.recall_at_1), share(s.recall_at_1_tight), share(s.recall_at_10),
                    share(s.proposed), claims(s.confident), claims(s.confident_right),
                    claims(s.confidently_wrong), claims(s.inaccurate),
                    fixedNumber(s.median_error_m, 3), fixedNumber(s.median_error_deg, 2),
                    fixedNumber(s.time_ms.median, 3), fixedNumber(s.time_ms.p95, 3),
                    fixedNumber(s.time_ms.mean, 3), fixedNumber(ratio, 2)});
  }
  return rows;
}

std::string reportMarkdown(const RelocateReport& report, const nlohmann::ordered_json& provenance,
                           const std::vector<std::string>& plots)
{
  std::ostringstream out;
  out << "# Relocation from one look\n\n" << relocateTable(report) << "\n";
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
    if (std::isnan(method.summary.ns_per_lookup)) continue;
    out << "* `" << method.name << "`: " << fixedNumber(method.summary.ns_per_lookup, 2)
        << " ns a look-up, everything included (the published figures of this search were taken at "
        << fixedNumber(kReferenceNsPerLookup, 1) << " ns: ratios to it scale with this).\n";
  }
  for (const std::string& plot : plots) out << "\n![" << plot << "](" << plot << ")\n";
  out << kDefinitions << "\n## Map\n\n* features: " << report.map_features
      << "\n* bytes, serialized: " << report.map_bytes
      << "\n* built in [s]: " << fixedNumber(report.map_build_seconds, 3) << "\n\n## Provenance\n\n"
      << provenanceSection(provenance);
  return out.str();
}

std::vector<std::string> drawPlots(const RelocateReport& report,
                                   const std::filesystem::path& folder)
{
  Plot errors{"Error of the first candidate",
              "distance from the truth [m]",
              "share of queries",
              true,
              false,
              {}};
  Plot times{"Time from raw scan to ranked candidates",
             "CPU time [ms]",
             "share of queries",
             true,
             false,
             {}};
  for (const RelocateMethodReport& method : report.methods)
  {
    std::vector<double> distances;
    std::vector<double> milliseconds;
    for (const RelocationRecord& record : method.records)
    {
      milliseconds.push_back(record.time_ms);
      // A logarithmic axis has no zero: a millimetre stands for less.
      if (record.error.distance >= 0) distances.push_back(std::max(0.001, record.error.distance));
    }
    errors.series.push_back(cumulativeShare(method.name, distances, method.records.size()));
    times.series.push_back(cumulativeShare(method.name, milliseconds, method.records.size()));
  }
  std::vector<std::string> drawn;
  if (drawPlot(errors, folder / "errors.png")) drawn.emplace_back("errors.png");
  if (drawPlot(times, folder / "times.png")) drawn.emplace_back("times.png");
  return drawn;
}
}  // namespace

std::string relocateTable(const RelocateReport& report)
{
  return markdownTable(tableRows(report));
}

void writeRelocateReport(const RelocateReport& report, const std::filesystem::path& folder)
{
  nlohmann::ordered_json json;
  for (const RelocateMethodReport& method : report.methods)
  {
    json["methods"][method.name] = methodJson(method);
  }
  json["map"] = {{"features", report.map_features},
                 {"build_s", report.map_build_seconds},
                 {"bytes", report.map_bytes}};
  json["complete"] = report.complete;
  json["without_truth"] = report.without_truth;
  json["provenance"] = toJson(report.provenance);
  makeFolder(folder);
  writeTextFile(folder / "results.csv", resultsCsv(report));
  writeTextFile(folder / "summary.json", json.dump(2) + "\n");
  const std::vector<std::string> plots = drawPlots(report, folder);
  writeTextFile(folder / "report.md", reportMarkdown(report, json["provenance"], plots));
}
}  // namespace sigloc
