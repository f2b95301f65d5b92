// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "config/columns.h"
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

/// One measure at one share of clutter.
struct ReliabilityRow
{
  double clutter;
  std::string measure;
  std::vector<double> right;
  std::vector<double> wrong;
  AreaUnderCurve curve;
};

PlotSeries curveOf(ReliabilityRow figures)
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
  PlotSeries curve{figures.measure, {}, false, {}};
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

std::vector<ReliabilityRow> rowsOf(const ReliabilityReport& report)
{
  std::set<double> clutters;
  for (const ReliabilityCase& judged : report.cases) clutters.insert(judged.clutter);
  std::vector<ReliabilityRow> rows;
  for (const double clutter : clutters)
  {
    for (const auto& [measure, value] : {std::pair("signature", &ReliabilityCase::signature),
                                         std::pair("mrpt", &ReliabilityCase::mrpt)})
    {
      ReliabilityRow& row = rows.emplace_back(ReliabilityRow{clutter, measure, {}, {}, {}});
      for (const ReliabilityCase& judged : report.cases)
      {
        if (judged.clutter != clutter) continue;
        (judged.right ? row.right : row.wrong).push_back(judged.*value);
      }
      row.curve = areaUnderCurve(row.right, row.wrong);
    }
  }
  return rows;
}

std::string intervalText(const ReliabilityRow& row)
{
  constexpr double kTwoSided = 1.96;
  const double half = kTwoSided * row.curve.sigma;
  return fmt::format("{:.4f}-{:.4f}", row.curve.area - half, std::min(1.0, row.curve.area + half));
}

Columns<ReliabilityRow> reliabilityColumns()
{
  using C = Column<ReliabilityRow>;
  return {
      C("", [](const ReliabilityRow& row) { return percentOf(row.clutter); }, "", 0, {"clutter %"}),
      C("right", [](const ReliabilityRow& row) { return row.right.size(); }, "", 0, {"right"}),
      C("wrong", [](const ReliabilityRow& row) { return row.wrong.size(); }, "", 0, {"wrong"}),
      C("", &ReliabilityRow::measure, "", 0, {"measure"}),
      C("auc", [](const ReliabilityRow& row) { return row.curve.area; }, "", 4, {"AUC"}),
      C("auc_sigma", [](const ReliabilityRow& row) { return row.curve.sigma; }),
      C("", intervalText, "", 0, {"95 %"})};
}

Columns<ReliabilityCase> caseColumns()
{
  using R = ReliabilityCase;
  using C = Column<R>;
  return {C("world", &R::world),
          C("clutter", &R::clutter),
          C("right", &R::right),
          C("error_m,error_deg", &R::error, "", 4),
          C("signature", &R::signature, "", 9),
          C("mrpt", &R::mrpt, "", 9)};
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
  return markdownTable(table(reliabilityColumns(), rowsOf(report)));
}

void writeReliabilityReport(const ReliabilityReport& report, const std::filesystem::path& folder)
{
  RunReport run;
  run.results = csvFile(caseColumns(), report.cases);
  for (const ReliabilityRow& row : rowsOf(report))
  {
    const std::string percent = percentOf(row.clutter);
    const Plot roc{"Am I lost? " + percent + " % clutter",
                   "false alarms (right poses)",
                   "noticed (wrong poses)",
                   false,
                   false,
                   {}};
    if (row.measure == "signature") run.plots.emplace_back("roc-" + percent + ".png", roc);
    run.plots.back().second.series.push_back(curveOf(row));
    run.summary["clutter"][fixedNumber(row.clutter, 2)][row.measure] =
        toJson(reliabilityColumns(), row);
  }
  run.summary["skipped"] = report.skipped;
  run.text = "# Am I lost?\n\n" + reliabilityTable(report);
  run.notes = kDefinitions;
  run.provenance = report.provenance;
  writeRunReport(run, folder);
}
}  // namespace sigloc
