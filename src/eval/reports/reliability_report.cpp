// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "config/fixed_number.h"
#include "config/TextStream.h"
#include "eval/protocols/reliability.h"
#include "eval/reports/plot.h"
#include "eval/reports/report_files.h"

namespace sigloc
{
namespace
{
constexpr const char* kDefinitions = R"(
## What the columns mean

* Simulated scans (361 beams, 270 degrees) in mapped offices, corridors of repeated rooms and halls.
  Each is asked about twice: at its **right** pose, predicted with 5 cm and 0.02 rad of error and
  refined as a tracker does, and at a **wrong** one, drawn from the look-alikes more than 1 m or 20
  degrees off that relocation proposes for that scan. Those were selected by the score that
  `signature` is made of, so the choice is no favour to it.
* `signature`: the belief's reliability. `mrpt`: `laserScanSimulatorWithUncertainty` (unscented) and
  `evaluateScanLikelihood` as pf-localization calls them, in a grid map of the same raster with the
  same pose and covariance.
* **AUC**: the probability that the right pose of a random pair has the higher figure, with its 95 %
  interval after Hanley and McNeil. The curves: share of wrong poses below a threshold (noticed)
  against share of right poses below it (false alarms).
)";

struct Measure
{
  const char* name;
  double ReliabilityCase::*value;
};
constexpr std::array kMeasures = {Measure{"signature", &ReliabilityCase::signature},
                                  Measure{"mrpt", &ReliabilityCase::mrpt}};

struct Figures
{
  std::vector<double> right;
  std::vector<double> wrong;
};

Figures figuresOf(const ReliabilityReport& report, double clutter, const Measure& measure)
{
  Figures figures;
  for (const ReliabilityCase& judged : report.cases)
  {
    if (judged.clutter != clutter) continue;
    (judged.right ? figures.right : figures.wrong).push_back(judged.*(measure.value));
  }
  return figures;
}

std::vector<double> cluttersOf(const ReliabilityReport& report)
{
  std::vector<double> shares;
  for (const ReliabilityCase& judged : report.cases) shares.push_back(judged.clutter);
  std::sort(shares.begin(), shares.end());
  shares.erase(std::unique(shares.begin(), shares.end()), shares.end());
  return shares;
}

PlotSeries curveOf(const std::string& name, Figures figures)
{
  std::sort(figures.right.begin(), figures.right.end());
  std::sort(figures.wrong.begin(), figures.wrong.end());
  std::vector<double> thresholds = figures.right;
  thresholds.insert(thresholds.end(), figures.wrong.begin(), figures.wrong.end());
  std::sort(thresholds.begin(), thresholds.end());
  const auto below = [](const std::vector<double>& sorted, double threshold)
  {
    const auto end = std::upper_bound(sorted.begin(), sorted.end(), threshold);
    return static_cast<double>(end - sorted.begin()) / static_cast<double>(sorted.size());
  };
  PlotSeries curve;
  curve.title = name;
  curve.points.emplace_back(0, 0);
  for (const double threshold : thresholds)
  {
    curve.points.emplace_back(below(figures.right, threshold), below(figures.wrong, threshold));
  }
  return curve;
}

std::string percentOf(double share)
{
  return fixedNumber(100 * share, 0);
}
}  // namespace

AreaUnderCurve areaUnderCurve(const std::vector<double>& right, std::vector<double> wrong)
{
  if (right.empty() || wrong.empty()) return {};
  std::sort(wrong.begin(), wrong.end());
  double won = 0;
  for (const double value : right)
  {
    const auto [low, high] = std::equal_range(wrong.begin(), wrong.end(), value);
    won += static_cast<double>(low - wrong.begin()) + 0.5 * static_cast<double>(high - low);
  }
  const auto m = static_cast<double>(right.size());
  const auto n = static_cast<double>(wrong.size());
  const double area = won / (m * n);
  const double q1 = area / (2 - area);
  const double q2 = 2 * area * area / (1 + area);
  const double variance =
      (area * (1 - area) + (m - 1) * (q1 - area * area) + (n - 1) * (q2 - area * area)) / (m * n);
  return {area, std::sqrt(std::max(0.0, variance))};
}

std::string reliabilityTable(const ReliabilityReport& report)
{
  std::vector<std::vector<std::string>> rows = {
      {"clutter %", "right", "wrong", "measure", "AUC", "95 %"}};
  for (const double clutter : cluttersOf(report))
  {
    for (const Measure& measure : kMeasures)
    {
      const Figures figures = figuresOf(report, clutter, measure);
      const AreaUnderCurve auc = areaUnderCurve(figures.right, figures.wrong);
      constexpr double kTwoSided = 1.96;
      rows.push_back({percentOf(clutter), std::to_string(figures.right.size()),
                      std::to_string(figures.wrong.size()), measure.name, fixedNumber(auc.area, 4),
                      fixedNumber(auc.area - kTwoSided * auc.sigma, 4) + "-" +
                          fixedNumber(std::min(1.0, auc.area + kTwoSided * auc.sigma), 4)});
    }
  }
  return markdownTable(rows);
}

void writeReliabilityReport(const ReliabilityReport& report, const std::filesystem::path& folder)
{
  RunReport run;
  TextStream csv;
  csv << "world,clutter,right,error_m,error_deg,signature,mrpt\n";
  for (const ReliabilityCase& judged : report.cases)
  {
    csv << judged.world << "," << fixedNumber(judged.clutter, 3) << "," << judged.right << ","
        << fixedNumber(judged.error.distance, 4) << "," << fixedNumber(judged.error.angle_deg, 3)
        << "," << fixedNumber(judged.signature, 9) << "," << fixedNumber(judged.mrpt, 9) << "\n";
  }
  run.results = csv.str();
  for (const double clutter : cluttersOf(report))
  {
    Plot roc{"Am I lost? " + percentOf(clutter) + " % clutter",
             "false alarms (right poses)",
             "noticed (wrong poses)",
             false,
             false,
             {}};
    for (const Measure& measure : kMeasures)
    {
      const Figures figures = figuresOf(report, clutter, measure);
      const AreaUnderCurve auc = areaUnderCurve(figures.right, figures.wrong);
      roc.series.push_back(curveOf(measure.name, figures));
      run.summary["clutter"][fixedNumber(clutter, 2)][measure.name] = {
          {"right", figures.right.size()},
          {"wrong", figures.wrong.size()},
          {"auc", auc.area},
          {"auc_sigma", auc.sigma}};
    }
    run.plots.emplace_back("roc-" + percentOf(clutter) + ".png", roc);
  }
  run.summary["skipped"] = report.skipped;
  run.text = "# Am I lost?\n\n" + reliabilityTable(report);
  run.notes = kDefinitions;
  run.provenance = report.provenance;
  writeRunReport(run, folder);
}
}  // namespace sigloc
