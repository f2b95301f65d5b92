// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/eval/scale.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "GrowthMeter.h"
#include "landmark_growth.h"
#include "sigloc/eval/feature_methods.h"
#include "sigloc/eval/report_files.h"

namespace sigloc
{
namespace
{
bool isRightPose(const FeatureHypothesis& hypothesis, const mrpt::math::TPose2D& truth,
                 const ScaleOptions& options)
{
  const auto& mean = hypothesis.pose.mean;
  return std::hypot(mean.x - truth.x, mean.y - truth.y) <= options.right_distance &&
         std::abs(mrpt::math::wrapToPi(mean.phi - truth.phi)) <= options.right_angle;
}

ScaleRow runRow(const std::string& method, const FeatureWorld& world, const FeatureMap& map,
                std::size_t wanted, const ScaleOptions& options)
{
  detail::GrowthMeter meter(method, wanted);
  const auto generator = meter.build(map, options.generator);
  Random random(options.seed, 1000 + wanted);
  const std::size_t poses = isLinearMethod(method) ? options.slow_poses : options.poses;
  for (std::size_t k = 0; k < poses; ++k)
  {
    const mrpt::math::TPose2D truth = randomPose(world, options.world, random);
    meter.ask(*generator, observeFeatures(world, truth, options.world, random, wanted),
              [&](const FeatureHypothesis& first) { return isRightPose(first, truth, options); });
  }
  return meter.row();
}

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

ScaleReport runScale(const ScaleOptions& options)
{
  if (options.map_features.empty()) throw std::invalid_argument("scale: needs a map size");
  checkFeatureMethods(options.methods);
  if (!options.dlr.empty()) return detail::runLandmarkGrowth(options);
  ScaleReport report;
  report.provenance.command = options.command;
  report.provenance.seed = options.seed;
  const auto add = [&](ScaleRow row)
  {
    if (options.progress) options.progress(detail::progressLine(row));
    report.rows.push_back(std::move(row));
  };
  for (std::size_t index = 0; index < options.map_features.size(); ++index)
  {
    Random random(options.seed, index);
    const FeatureWorld world = makeFeatureWorld(options.map_features[index], options.world, random);
    const FeatureMap map(world.mapped);
    for (const std::string& method : options.methods)
    {
      if (isLinearMethod(method) && options.map_features[index] > options.slow_limit) continue;
      add(runRow(method, world, map, 0, options));
      if (index > 0) continue;
      for (const std::size_t wanted : options.observed)
      {
        add(runRow(method, world, map, wanted, options));
      }
    }
  }
  return report;
}

std::string scaleTable(const ScaleReport& report)
{
  std::vector<std::vector<std::string>> rows{{"method", "map features", "observed", "success",
                                              "ms median", "p95", "mean", "pairs", "hypotheses",
                                              "checks", "cut short", "build s", "bytes/feature"}};
  for (const ScaleRow& row : report.rows)
  {
    rows.push_back({row.method, std::to_string(row.map_features), fixedNumber(row.observed, 1),
                    withInterval(row.success), fixedNumber(row.time_ms.median, 3),
                    fixedNumber(row.time_ms.p95, 3), fixedNumber(row.time_ms.mean, 3),
                    fixedNumber(row.signature_pairs, 0), fixedNumber(row.hypotheses, 0),
                    fixedNumber(row.checks, 0), std::to_string(row.cut_short),
                    fixedNumber(row.build_seconds, 2), fixedNumber(row.bytes_per_feature, 0)});
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
  std::ostringstream csv;
  csv << "method,map_features,wanted,observed,success,cases,signature_pairs,hypotheses,checks,cut_"
         "short,"
         "time_ms_median,time_ms_p95,time_ms_mean\n";
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
  files.results = csv.str();
  files.text = "# Growth" + report.where + "\n\n" + scaleTable(report);
  files.plots = growthPlots(report);
  files.provenance = report.provenance;
  writeRunReport(files, folder);
}
}  // namespace sigloc
