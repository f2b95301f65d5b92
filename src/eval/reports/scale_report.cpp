// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "config/fixed_number.h"
#include "config/TextStream.h"
#include "eval/process/cpu_time.h"
#include "eval/protocols/scale.h"
#include "eval/reports/relocation_rows.h"
#include "eval/reports/report_files.h"

namespace sigloc
{
namespace
{
constexpr const char* kDefinitions = R"(
## What the columns mean

* **success**: the first hypothesis is right: within 0.3 m and 0.06 rad, on a log 0.5 m and 10 degrees.
* **ratio**: median time over that of the same method in a map of 1000 features, or, where that was not
  run, in its smallest map.
* **pairs**, **hypotheses**, **checks**: signatures compared, base pairings turned into a pose, and
  pairings checked at a pose, in the mean of a query; operations are their sum.
* **cut short**: searches that ended at their budget.
* **time**: CPU time of one thread; there are no scans, so no extraction is in it.
)";

std::vector<std::string> methodsOf(const ScaleReport& report)
{
  std::vector<std::string> methods;
  for (const ScaleRow& row : report.rows)
  {
    if (std::find(methods.begin(), methods.end(), row.method) == methods.end())
    {
      methods.push_back(row.method);
    }
  }
  return methods;
}

using Curve = std::vector<std::pair<double, double>>;

/// A quantity of one method over the map's size, or over the scene's where that was varied.
template <class Value>
Curve curveOf(const ScaleReport& report, const std::string& method, bool over_observed,
              Value&& value)
{
  Curve curve;
  for (const ScaleRow& row : report.rows)
  {
    if (row.method != method || (row.wanted > 0) != over_observed) continue;
    const double x = over_observed ? row.observed : static_cast<double>(row.map_features);
    curve.emplace_back(x, value(row));
  }
  return curve;
}

double operationsOf(const ScaleRow& row)
{
  return row.operations();
}
double medianOf(const ScaleRow& row)
{
  return row.time_ms.median;
}

/// The median time over that of the same method's reference map.
double timeRatio(const ScaleReport& report, const ScaleRow& row)
{
  constexpr std::size_t kReference = 1000;
  const ScaleRow* reference = nullptr;
  for (const ScaleRow& other : report.rows)
  {
    if (other.method != row.method || other.wanted > 0) continue;
    const bool better =
        reference == nullptr || other.map_features == kReference ||
        (reference->map_features != kReference && other.map_features < reference->map_features);
    if (better) reference = &other;
  }
  return reference ? row.time_ms.median / reference->time_ms.median
                   : std::numeric_limits<double>::quiet_NaN();
}

/// What every sub-command's summary tells, of all poses of a method.
RelocationSummary pooled(const ScaleReport& report, const std::string& method)
{
  RelocationSummary s;
  std::vector<double> times;
  std::vector<double> distances;
  std::vector<double> angles;
  const auto append = [](std::vector<double>& to, const std::vector<double>& from)
  { to.insert(to.end(), from.begin(), from.end()); };
  for (const ScaleRow& row : report.rows)
  {
    if (row.method != method) continue;
    s.queries += row.success.cases;
    s.recall_at_1.cases += row.success.cases;
    s.recall_at_1.count += row.success.count;
    s.cut_short += row.cut_short;
    append(times, row.each_ms);
    append(distances, row.right_errors_m);
    append(angles, row.right_errors_deg);
  }
  s.time_ms = quantilesOf(times);
  s.median_error_m = quantilesOf(distances).median;
  s.median_error_deg = quantilesOf(angles).median;
  return s;
}

std::string exponentText(const Curve& curve)
{
  if (curve.size() < 2) return "-";
  const FittedExponent fit = fitExponent(curve);
  if (curve.size() == 2) return fixedNumber(fit.slope, 2);
  return fixedNumber(fit.slope, 2) + " (" + fixedNumber(fit.low, 2) + " to " +
         fixedNumber(fit.high, 2) + ")";
}
/// Time and operations over the sizes of the map and of the scene, as far as they were varied.
std::vector<std::pair<std::string, Plot>> growthPlots(const ScaleReport& report)
{
  const struct
  {
    const char* file;
    const char* x;
    const char* y;
    bool over_observed;
    double (*value)(const ScaleRow&);
  } figures[] = {
      {"time.png", "map features", "median time [ms]", false, medianOf},
      {"operations.png", "map features", "operations", false, operationsOf},
      {"time-observed.png", "observed features", "median time [ms]", true, medianOf},
      {"operations-observed.png", "observed features", "operations", true, operationsOf}};
  std::vector<std::pair<std::string, Plot>> plots;
  for (const auto& figure : figures)
  {
    Plot plot{"Growth" + report.where, figure.x, figure.y, true, true, {}};
    for (const std::string& method : methodsOf(report))
    {
      const Curve curve = curveOf(report, method, figure.over_observed, figure.value);
      if (curve.size() > 1) plot.series.push_back({method, curve, true, {}});
    }
    if (!plot.series.empty()) plots.emplace_back(figure.file, plot);
  }
  return plots;
}
}  // namespace

FittedExponent fitExponent(const Curve& points)
{
  const auto n = static_cast<double>(points.size());
  double sx = 0;
  double sy = 0;
  for (const auto& [x, y] : points)
  {
    sx += std::log(x) / n;
    sy += std::log(std::max(y, 1e-12)) / n;
  }
  double xx = 0;
  double xy = 0;
  for (const auto& [x, y] : points)
  {
    xx += (std::log(x) - sx) * (std::log(x) - sx);
    xy += (std::log(x) - sx) * (std::log(std::max(y, 1e-12)) - sy);
  }
  FittedExponent fit;
  fit.slope = xx > 0 ? xy / xx : 0;
  double residuals = 0;
  for (const auto& [x, y] : points)
  {
    const double off = std::log(std::max(y, 1e-12)) - sy - fit.slope * (std::log(x) - sx);
    residuals += off * off;
  }
  const double spread = n > 2 && xx > 0 ? 1.96 * std::sqrt(residuals / (n - 2) / xx) : 0;
  fit.low = fit.slope - spread;
  fit.high = fit.slope + spread;
  return fit;
}

std::string scaleTable(const ScaleReport& report)
{
  std::vector<std::vector<std::string>> rows{
      {"method", "map features", "observed", "success", "ms median", "p95", "mean", "ratio",
       "pairs", "hypotheses", "checks", "cut short", "build s", "bytes/feature"}};
  for (const ScaleRow& row : report.rows)
  {
    rows.push_back({row.method, std::to_string(row.map_features), fixedNumber(row.observed, 1),
                    withInterval(row.success), fixedNumber(row.time_ms.median, 3),
                    fixedNumber(row.time_ms.p95, 3), fixedNumber(row.time_ms.mean, 3),
                    fixedNumber(timeRatio(report, row), 2), fixedNumber(row.signature_pairs, 0),
                    fixedNumber(row.hypotheses, 0), fixedNumber(row.checks, 0),
                    std::to_string(row.cut_short), fixedNumber(row.build_seconds, 2),
                    fixedNumber(row.bytes_per_feature, 0)});
  }
  std::vector<std::vector<std::string>> exponents{
      {"method", "operations in m", "median time in m", "operations in n", "median time in n"}};
  for (const std::string& method : methodsOf(report))
  {
    exponents.push_back({method, exponentText(curveOf(report, method, false, operationsOf)),
                         exponentText(curveOf(report, method, false, medianOf)),
                         exponentText(curveOf(report, method, true, operationsOf)),
                         exponentText(curveOf(report, method, true, medianOf))});
  }
  return markdownTable(rows) + "\nFitted exponents (95 % interval):\n\n" + markdownTable(exponents);
}

void writeScaleReport(const ScaleReport& report, const std::filesystem::path& folder)
{
  RunReport files;
  nlohmann::ordered_json& json = files.summary;
  TextStream csv;
  csv << "method,map_features,wanted,observed,success,cases,signature_pairs,hypotheses,checks,cut_"
         "short,"
         "time_ms_median,time_ms_p95,time_ms_mean\n";
  for (const std::string& method : methodsOf(report))
  {
    json["methods"][method] = toJson(pooled(report, method));
    json["methods"][method]["peak_rss_mb"] = peakMemoryMb();
  }
  for (const ScaleRow& row : report.rows)
  {
    csv << row.method << ',' << row.map_features << ',' << row.wanted << ','
        << fixedNumber(row.observed, 3) << ',' << row.success.count << ',' << row.success.cases
        << ',' << fixedNumber(row.signature_pairs, 3) << ',' << fixedNumber(row.hypotheses, 3)
        << ',' << fixedNumber(row.checks, 3) << ',' << row.cut_short << ','
        << fixedNumber(row.time_ms.median, 4) << ',' << fixedNumber(row.time_ms.p95, 4) << ','
        << fixedNumber(row.time_ms.mean, 4) << '\n';
    nlohmann::ordered_json entry;
    entry["map_features"] = row.map_features;
    entry["observed"] = row.observed;
    addProportion(entry, "success", row.success);
    entry["operations"] = row.operations();
    entry["cut_short"] = row.cut_short;
    entry["time_ms"] = toJson(row.time_ms);
    entry["time_ratio"] = timeRatio(report, row);
    entry["build_s"] = row.build_seconds;
    entry["bytes_per_feature"] = row.bytes_per_feature;
    json["methods"][row.method]["rows"].push_back(entry);
  }
  for (const std::string& method : methodsOf(report))
  {
    const Curve operations = curveOf(report, method, false, operationsOf);
    const Curve over_observed = curveOf(report, method, true, operationsOf);
    const Curve time_over_observed = curveOf(report, method, true, medianOf);
    const Curve time = curveOf(report, method, false, medianOf);
    if (operations.size() > 1)
    {
      json["methods"][method]["operations_exponent_in_m"] = fitExponent(operations).slope;
      json["methods"][method]["time_exponent_in_m"] = fitExponent(time).slope;
    }
    if (over_observed.size() > 1)
    {
      json["methods"][method]["operations_exponent_in_n"] = fitExponent(over_observed).slope;
      json["methods"][method]["time_exponent_in_n"] = fitExponent(time_over_observed).slope;
    }
  }
  json["map"] = toJson(report.map);
  files.results = csv.str();
  files.text = "# Growth" + report.where + "\n\n" + scaleTable(report);
  files.plots = growthPlots(report);
  files.notes = kDefinitions + mapSection(report.map);
  files.provenance = report.provenance;
  writeRunReport(files, folder);
}
}  // namespace sigloc
