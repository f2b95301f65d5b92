// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/reports/wakeup_calibration.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "config/columns.h"
#include "eval/reports/report_files.h"

namespace sigloc::detail
{
namespace
{
constexpr std::array<double, 6> kBinBorders = {0.5, 0.7, 0.9, 0.97, 0.99, 1.0 + 1e-9};
constexpr double kEllipse = 7.815;  // chi-square, 3 degrees of freedom, 95 %

using Bin = CalibrationBin;

bool isIn(const Bin& bin, const TrackingClaim& claim)
{
  const double weight = claim.weights.front();
  return claim.confident == bin.claims &&
         (claim.confident || (weight >= bin.low && weight < bin.high));
}

/// Counts the steps of a run in a bin, and their unbroken stretches, right or wrong.
void countInto(Bin& bin, const Wakeup& run, const AccuracyGates& gates)
{
  bool open = false;
  bool open_wrong = false;
  const auto close = [&]
  {
    if (!open) return;
    bin.wrong_episodes.add(open_wrong);
    open = open_wrong = false;
  };
  for (const WakeupStep& step : run.steps)
  {
    if (!isIn(bin, step.claim))
    {
      close();
      continue;
    }
    const bool wrong =
        step.judged == Claim::wrong || (!step.claim.confident && !isRight(step.error, gates));
    bin.wrong_steps.add(wrong);
    open = true;
    open_wrong = open_wrong || wrong;
  }
  close();
}

Written weightsOf(const Bin& bin)
{
  if (bin.claims) return {{}, {"localized"}};
  return {{{"", {bin.low, std::min(1.0, bin.high)}}},
          {fmt::format("{:.2f}-{:.2f}, no claim", bin.low, bin.high)}};
}

std::string percent(const Proportion& p)
{
  if (p.cases == 0) return "-";
  return fmt::format("{:.2f} ({:.2f}-{:.2f})", 100 * p.value(), 100 * p.low(), 100 * p.high());
}

Columns<Bin> binColumns()
{
  using C = Column<Bin>;
  return {
      C("weight", weightsOf, "", 0, {"weight of the first"}),
      C("steps", [](const Bin& bin) { return bin.wrong_steps.cases; }, "", 0, {"steps"}),
      C("wrong_steps", &Bin::wrong_steps),
      C("", [](const Bin& bin) { return percent(bin.wrong_steps); }, "", 0, {"not right %"}),
      C("episodes", [](const Bin& bin) { return bin.wrong_episodes.cases; }, "", 0, {"episodes"}),
      C("wrong_episodes", &Bin::wrong_episodes),
      C("", [](const Bin& bin) { return percent(bin.wrong_episodes); }, "", 0, {"not right %"})};
}
}  // namespace

SelfKnowledge selfKnowledgeOf(const WakeupMethodReport& method, const AccuracyGates& gates)
{
  SelfKnowledge knowledge;
  const bool tells = std::any_of(method.runs.begin(), method.runs.end(),
                                 [](const Wakeup& run)
                                 { return !run.steps.empty() && run.steps.front().claim.belief; });
  if (!tells) return knowledge;
  for (std::size_t b = 0; b + 1 < kBinBorders.size(); ++b)
    knowledge.bins.push_back({kBinBorders[b], kBinBorders[b + 1], false, {}, {}});
  knowledge.bins.push_back({0.99, 1, true, {}, {}});
  std::vector<double> nees;
  for (const Wakeup& run : method.runs)
  {
    for (Bin& bin : knowledge.bins) countInto(bin, run, gates);
    for (const WakeupStep& s : run.steps)
    {
      if (s.judged != Claim::right || std::isnan(s.nees)) continue;
      nees.push_back(s.nees);
      knowledge.in_ellipse.add(s.nees <= kEllipse);
    }
  }
  knowledge.nees = quantilesOf(nees);
  return knowledge;
}

nlohmann::ordered_json toJson(const SelfKnowledge& knowledge)
{
  nlohmann::ordered_json json;
  for (const Bin& bin : knowledge.bins)
  {
    const nlohmann::ordered_json of_bin = sigloc::toJson(binColumns(), bin);
    bin.claims ? json["claimed"] = of_bin : json["not_claimed"].emplace_back(of_bin);
  }
  addJson(json, "nees", knowledge.nees);
  addJson(json, "in_95_ellipse", knowledge.in_ellipse);
  return json;
}

std::string toMarkdown(const SelfKnowledge& knowledge)
{
  if (knowledge.bins.empty()) return {};
  return markdownTable(table(binColumns(), knowledge.bins)) +
         "\nSquared normalised error of right claims (3 expected): mean " +
         fixedNumber(knowledge.nees.mean, 2) + ", median " + fixedNumber(knowledge.nees.median, 2) +
         "; in the 95 % ellipse: " + percent(knowledge.in_ellipse) + " %\n";
}

std::vector<std::pair<std::string, Plot>> beliefPlots(const WakeupMethodReport& method)
{
  constexpr double kBin = 0.5;  // [m]
  constexpr std::size_t kRunsDrawn = 6;
  Plot count{"Hypotheses alive, " + method.name, "distance [m]", "hypotheses", false, false, {}};
  Plot weights{"Weight of the first and second hypothesis, " + method.name,
               "distance [m]",
               "weight",
               false,
               false,
               {}};
  std::map<int, std::vector<double>> alive;
  for (const Wakeup& run : method.runs)
  {
    for (const WakeupStep& step : run.steps)
    {
      if (!step.claim.belief) return {};
      alive[static_cast<int>(step.travelled / kBin)].push_back(step.claim.hypotheses);
    }
  }
  PlotSeries mean{"mean", {}, false, {}};
  PlotSeries p95{"95 % of the runs", {}, false, {}};
  for (const auto& [bin, values] : alive)
  {
    const Quantiles q = quantilesOf(values);
    mean.points.emplace_back(kBin * bin, q.mean);
    p95.points.emplace_back(kBin * bin, q.p95);
  }
  count.series = {mean, p95};
  for (const std::size_t r : evenlySpaced(method.runs.size(), kRunsDrawn))
  {
    const Wakeup& run = method.runs[r];
    PlotSeries first{"start " + std::to_string(run.start), {}, false, {}};
    PlotSeries second{"its rival", {}, false, {}};
    for (const WakeupStep& step : run.steps)
    {
      first.points.emplace_back(step.travelled, step.claim.weights[0]);
      second.points.emplace_back(step.travelled, step.claim.weights[1]);
    }
    weights.series.push_back(first);
    weights.series.push_back(second);
  }
  return {{"hypotheses-" + method.name + ".png", count},
          {"weights-" + method.name + ".png", weights}};
}
}  // namespace sigloc::detail
