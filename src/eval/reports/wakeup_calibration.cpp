// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/reports/wakeup_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "config/fixed_number.h"
#include "eval/reports/report_files.h"

namespace sigloc::detail
{
namespace
{
constexpr std::array<double, 6> kBinBorders = {0.5, 0.7, 0.9, 0.97, 0.99, 1.0 + 1e-9};
constexpr double kEllipse = 7.815;  // chi-square, 3 degrees of freedom, 95 %

/// Counts the steps for which `inside` holds, and their unbroken stretches, right or wrong.
template <class Inside>
void countInto(CalibrationBin& bin, const Wakeup& run, const AccuracyGates& gates, Inside&& inside)
{
  bool open = false;
  bool open_wrong = false;
  const auto close = [&]
  {
    if (!open) return;
    ++bin.wrong_episodes.cases;
    bin.wrong_episodes.count += open_wrong;
    open = open_wrong = false;
  };
  for (const WakeupStep& step : run.steps)
  {
    if (!inside(step))
    {
      close();
      continue;
    }
    const bool wrong =
        step.judged == Claim::wrong || (!step.claim.confident && !isRight(step.error, gates));
    ++bin.wrong_steps.cases;
    bin.wrong_steps.count += wrong;
    open = true;
    open_wrong = open_wrong || wrong;
  }
  close();
}

std::string percent(const Proportion& p)
{
  if (p.cases == 0) return "-";
  return fixedNumber(100 * p.value(), 2) + " (" + fixedNumber(100 * p.low(), 2) + "-" +
         fixedNumber(100 * p.high(), 2) + ")";
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
  {
    CalibrationBin bin{kBinBorders[b], kBinBorders[b + 1], {}, {}};
    for (const Wakeup& run : method.runs)
    {
      countInto(bin, run, gates,
                [&](const WakeupStep& s)
                {
                  const double weight = s.claim.weights.front();
                  return !s.claim.confident && weight >= bin.low && weight < bin.high;
                });
    }
    knowledge.bins.push_back(bin);
  }
  CalibrationBin claims{0.99, 1, {}, {}};
  std::vector<double> nees;
  for (const Wakeup& run : method.runs)
  {
    countInto(claims, run, gates, [](const WakeupStep& s) { return s.claim.confident; });
    for (const WakeupStep& s : run.steps)
    {
      if (s.judged != Claim::right || std::isnan(s.nees)) continue;
      nees.push_back(s.nees);
      ++knowledge.in_ellipse.cases;
      knowledge.in_ellipse.count += s.nees <= kEllipse;
    }
  }
  knowledge.bins.push_back(claims);
  knowledge.nees = quantilesOf(nees);
  return knowledge;
}

nlohmann::ordered_json toJson(const SelfKnowledge& knowledge)
{
  nlohmann::ordered_json json;
  const auto add = [](nlohmann::ordered_json& object, const CalibrationBin& bin)
  {
    object["steps"] = bin.wrong_steps.cases;
    addProportion(object, "wrong_steps", bin.wrong_steps);
    object["episodes"] = bin.wrong_episodes.cases;
    addProportion(object, "wrong_episodes", bin.wrong_episodes);
  };
  for (std::size_t b = 0; b + 1 < knowledge.bins.size(); ++b)
  {
    nlohmann::ordered_json bin;
    bin["weight"] = {knowledge.bins[b].low, std::min(1.0, knowledge.bins[b].high)};
    add(bin, knowledge.bins[b]);
    json["not_claimed"].push_back(bin);
  }
  if (!knowledge.bins.empty()) add(json["claimed"], knowledge.bins.back());
  json["nees"] = sigloc::toJson(knowledge.nees);
  addProportion(json, "in_95_ellipse", knowledge.in_ellipse);
  return json;
}

std::string toMarkdown(const SelfKnowledge& knowledge)
{
  if (knowledge.bins.empty()) return {};
  std::vector<std::vector<std::string>> rows = {
      {"weight of the first", "steps", "not right %", "episodes", "not right %"}};
  for (std::size_t b = 0; b < knowledge.bins.size(); ++b)
  {
    const CalibrationBin& bin = knowledge.bins[b];
    const bool claims = b + 1 == knowledge.bins.size();
    rows.push_back({claims
                        ? "localized"
                        : fixedNumber(bin.low, 2) + "-" + fixedNumber(bin.high, 2) + ", no claim",
                    std::to_string(bin.wrong_steps.cases), percent(bin.wrong_steps),
                    std::to_string(bin.wrong_episodes.cases), percent(bin.wrong_episodes)});
  }
  return markdownTable(rows) + "\nSquared normalised error of right claims (3 expected): mean " +
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
  PlotSeries mean;
  mean.title = "mean";
  PlotSeries p95;
  p95.title = "95 % of the runs";
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
    PlotSeries first;
    first.title = "start " + std::to_string(run.start);
    PlotSeries second;
    second.title = "its rival";
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
