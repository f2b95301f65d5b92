// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "eval/process/cpu_time.h"
#include "eval/protocols/scale.h"
#include "eval/reports/report_files.h"

namespace sigloc
{
namespace
{
using Curve = std::vector<std::pair<double, double>>;

/// What is varied: the features of the map, those observed, or the mapped area.
enum class Axis : std::uint8_t
{
  features,
  observed,
  area,
};

Axis axisOf(const ScaleRow& row)
{
  if (!std::isnan(row.area)) return Axis::area;
  return row.wanted > 0 ? Axis::observed : Axis::features;
}

double placeOn(Axis axis, const ScaleRow& row)
{
  if (axis == Axis::area) return row.area;
  return axis == Axis::observed ? row.observed : static_cast<double>(row.map_features);
}

/// A quantity of one method over what was varied.
template <class Value>
Curve curveOf(const ScaleReport& report, const std::string& method, Axis axis, Value&& value)
{
  Curve curve;
  for (const ScaleRow& row : report.rows)
  {
    if (row.method != method || axisOf(row) != axis) continue;
    curve.emplace_back(placeOn(axis, row), value(row));
  }
  return curve;
}

double operationsOf(const ScaleRow& row)
{
  return row.operations();
}

double meanTimeOf(const ScaleRow& row)
{
  return quantiles(&Outcome::times_ms)(row).mean;
}

double mapSecondsOf(const ScaleRow& row)
{
  return row.map_seconds;
}

/// The rows, their times compared with those of the same method's reference map.
std::vector<ScaleRow> ratedRows(const ScaleReport& report)
{
  constexpr std::size_t kReference = 1000;
  std::vector<ScaleRow> rows = report.rows;
  for (ScaleRow& row : rows)
  {
    const ScaleRow* reference = nullptr;
    for (const ScaleRow& other : report.rows)
    {
      if (other.method != row.method || other.wanted > 0) continue;
      const bool better =
          reference == nullptr || other.map_features == kReference ||
          (reference->map_features != kReference && other.map_features < reference->map_features);
      if (better) reference = &other;
    }
    if (reference) row.reference_ms = medianTime(*reference);
  }
  return rows;
}

Columns<ScaleRow> rowColumns()
{
  using R = ScaleRow;
  using C = Column<R>;
  constexpr int kTimes = 1, kWork = 2;
  const auto times = quantiles(&Outcome::times_ms);
  constexpr Files kJson = Files::json, kCsv = Files::csv;
  return {
      C("method", &R::method, "", 0, {"method"}, 0, kCsv),
      C("map_features", &R::map_features, "", 0, {"map features"}),
      C("wanted", &R::wanted, "observed features asked for; 0: all", 0, {}, 0, kCsv),
      C("observed", &R::observed, "features, in the mean of the queries"),
      C("", &R::observed, "", 1, {"observed"}),
      C("success", share(&Outcome::right),
        "the first hypothesis is right: within 0.3 m and 0.06 rad, on a log and among buildings "
        "0.5 m and 10 degrees",
        0, {"success"}, 0, kJson),
      C("success", total([](const Outcome& o) { return o.right == true; }), "", 0, {}, 0, kCsv),
      C(
          "cases", [](const R& row) { return row.records.size(); }, "", 0, {}, 0, kCsv),
      C("operations", &R::operations, "sum of pairs, hypotheses, checks and visits", 3, {}, 0,
        kJson),
      C("signature_pairs", &R::signature_pairs, "", 3, {}, 0, kCsv),
      C("", &R::signature_pairs, "signatures compared, in the mean of a query", 0, {"pairs"},
        kWork),
      C("hypotheses", &R::hypotheses, "", 3, {}, 0, kCsv),
      C("", &R::hypotheses, "base pairings turned into a pose, in the mean of a query", 0,
        {"hypotheses"}, kWork),
      C("checks", &R::checks, "", 3, {}, 0, kCsv),
      C("", &R::checks, "pairings checked at a pose, in the mean of a query", 0, {"checks"}, kWork),
      C("visits", &R::visits, "", 3, {}, 0, kCsv),
      C("", &R::visits, "cells and list entries read, in the mean of a query", 0, {"visits"},
        kWork),
      C("cut_short", total(&Outcome::cut_short), "searches that ended at their budget", 0,
        {"cut short"}, kWork),
      C("time_ms", times,
        "CPU time of one thread; among buildings with extraction, elsewhere there are no scans", 3,
        {"ms median", "p95", "mean"}, kTimes, kJson),
      C("time_ms_median,time_ms_p95,time_ms_mean", times, "", 4, {}, 0, kCsv),
      C(
          "time_ratio", [](const R& row) { return medianTime(row) / row.reference_ms; },
          "median time over that of the same method in a map of 1000 features, or, where that was "
          "not run, in its smallest map",
          2, {"ratio"}, kTimes, kJson),
      C("build_s", &R::build_seconds, "CPU time of building the index", 2, {"build s"}, kWork,
        kJson),
      C("bytes_per_feature", &R::bytes_per_feature, "of the map and its index", 0,
        {"bytes/feature"}, kWork, kJson),
      C("area_m2", &R::area, "of all buildings in the map", 0, {"area m2"}),
      C("bytes_per_m2", &R::bytes_per_m2, "of the map and its index over the area", 0, {"bytes/m2"},
        kWork, kJson),
      C("map_build_s", &R::map_seconds, "CPU time of building the map from its scans", 2,
        {"map build s"}, kWork)};
}

/// The exponent that a curve grows with, as far as it has points for one.
Written exponentOf(const Curve& curve)
{
  if (curve.size() < 2) return {{}, {"-"}};
  const FittedExponent fit = fitExponent(curve);
  std::string text = fixedNumber(fit.slope, 2);
  if (curve.size() > 2) text += fmt::format(" ({:.2f} to {:.2f})", fit.low, fit.high);
  return {{{"", fit.slope}}, {text}};
}

/// The rows of a method.
struct Growth
{
  std::string method;
  const ScaleReport& report;
};

auto exponent(Axis axis, double (*value)(const ScaleRow&))
{
  return [=](const Growth& growth)
  { return exponentOf(curveOf(growth.report, growth.method, axis, value)); };
}

Columns<Growth> exponentColumns()
{
  using C = Column<Growth>;
  const auto time = medianTime<ScaleRow>;
  return {C("", &Growth::method, "", 0, {"method"}),
          C("operations_exponent_in_m", exponent(Axis::features, operationsOf), "", 2,
            {"operations in m"}),
          C("time_exponent_in_m", exponent(Axis::features, time), "", 2, {"median time in m"}),
          C("operations_exponent_in_n", exponent(Axis::observed, operationsOf), "", 2,
            {"operations in n"}),
          C("time_exponent_in_n", exponent(Axis::observed, time), "", 2, {"median time in n"}),
          C("time_exponent_in_area", exponent(Axis::area, time), "", 2, {"median time in area"}),
          C("mean_time_exponent_in_area", exponent(Axis::area, meanTimeOf), "", 2,
            {"mean time in area"}),
          C("map_build_exponent_in_area", exponent(Axis::area, mapSecondsOf), "", 2,
            {"map building in area"})};
}

/// Time and operations over the sizes of the map and of the scene, as far as they were varied.
std::vector<std::pair<std::string, Plot>> growthPlots(const ScaleReport& report)
{
  const struct
  {
    const char* file;
    const char* x;
    const char* y;
    Axis axis;
    double (*value)(const ScaleRow&);
  } figures[] = {
      {"time.png", "map features", "median time [ms]", Axis::features, medianTime<ScaleRow>},
      {"operations.png", "map features", "operations", Axis::features, operationsOf},
      {"time-observed.png", "observed features", "median time [ms]", Axis::observed,
       medianTime<ScaleRow>},
      {"operations-observed.png", "observed features", "operations", Axis::observed, operationsOf},
      {"time-area.png", "mapped area [m2]", "median time [ms]", Axis::area, medianTime<ScaleRow>},
      {"build-area.png", "mapped area [m2]", "time of map building [s]", Axis::area, mapSecondsOf}};
  std::vector<std::pair<std::string, Plot>> plots;
  for (const auto& figure : figures)
  {
    Plot plot{"Growth" + report.where, figure.x, figure.y, true, true, {}};
    for (const std::string& method : methodsOf(report.rows))
    {
      const Curve curve = curveOf(report, method, figure.axis, figure.value);
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
  // Two parameters are fitted, so that two points leave nothing to tell the error by.
  double spread = std::numeric_limits<double>::infinity();
  if (n > 2 && xx > 0)
  {
    const boost::math::students_t distribution(n - 2);
    spread = boost::math::quantile(distribution, 0.975) * std::sqrt(residuals / (n - 2) / xx);
  }
  fit.low = fit.slope - spread;
  fit.high = fit.slope + spread;
  return fit;
}

std::string scaleTable(const ScaleReport& report)
{
  std::vector<Cells> exponents = {tableHead(exponentColumns())};
  for (const std::string& method : methodsOf(report.rows))
    exponents.push_back(tableRow(exponentColumns(), {method, report}));
  return markdownTable(table(rowColumns(), ratedRows(report))) +
         "\nFitted exponents (95 % interval):\n\n" + markdownTable(exponents);
}

void writeScaleReport(const ScaleReport& report, const std::filesystem::path& folder)
{
  RunReport files;
  nlohmann::ordered_json& json = files.summary;
  const std::vector<ScaleRow> rows = ratedRows(report);
  json["methods"] = methodsJson(rows, rowColumns(), peakMemoryMb());
  for (const std::string& method : methodsOf(report.rows))
    json["methods"][method].update(toJson(exponentColumns(), {method, report}));
  json["map"] = toJson(mapColumns(), report.map);
  files.results = csvFile(rowColumns(), rows);
  files.text = "# Growth" + report.where + "\n\n" + scaleTable(report);
  files.plots = growthPlots(report);
  files.notes = legend("What the columns mean", rowColumns()) + mapSection(report.map);
  files.provenance = report.provenance;
  writeRunReport(files, folder);
}
}  // namespace sigloc
