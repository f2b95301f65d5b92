// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "config/fixed_number.h"
#include "config/TextStream.h"
#include "eval/reports/relocation_rows.h"
#include "eval/reports/report_files.h"
#include "eval/reports/wakeup_calibration.h"
#include "eval/wakeup/wakeup.h"

namespace sigloc
{
namespace
{
/// What the columns mean, claims being judged by these gates.
std::string definitions(const AccuracyGates& gates)
{
  TextStream text;
  text
      << R"(
## What the columns mean

* A run wakes up lost at one place and drives on. **right at end**: confident and within )"
      << gates.right_distance << " m and\n  " << gates.right_angle_deg
      << R"( degrees of the truth at the last step with truth within 1 m of a mapped pose (mapped area).
  **settled**: confident from some step to the end, steps off the mapped area aside; the distance to
  it is over the runs that settle, the CPU time (building the filter included) over all: a run that
  never settles costs its whole time. After a kidnapping way, time and CPU time count from there, and
  no run has settled before it noticed.
* **wrong**: runs with a step that is confident and more than )"
      << gates.wrong_distance << " m or " << gates.wrong_angle_deg << R"( degrees off; steps and
  unbroken episodes of it counted as well. **of them mapped**: runs with such a step where the truth is
  within 1 m of a mapped pose; the others claimed a place of the map from outside its mapped area only.
* **noticed**: after a kidnapping, runs in which the method was not, or no longer, sure of a wrong
  place, and how far and how long after; *s* is the time of the drive, by the log.
* In `summary.json`, `confident`, `confident_right` and `inaccurate` count runs by their last step with
  truth on mapped area, `confidently_wrong` those that were wrong at any step; `recall_at_1` is the share whose best
  pose is right there, sure or not. A run that saw nothing has fewer than 10 beams in every step.
* Confident: for `signature` and `signature-mcl` the verdict `localized`; for MRPT's filter a position sd below 0.5 m
  and a heading sd below 10 degrees over 5 steps.
* `signature-mcl`: MRPT's filter with 500 particles, drawn where signatures find a lost robot.
* `mcl`: MRPT's filter with pf-localization's shipped options (KLD, 40 000 particles at first), driven
  as that program does: its map, the log's own model of the motion, no update at the first step.
  `mcl-fixed`: 40 000 throughout. `mcl-tuned`: 200 particles per free square metre, between 40 000 and
  200 000, KLD down to 1 000 on cells of 0.5 m, motion noise of at least 5 cm and 2 degrees a step.
  One thread each.
* `mcl-stock`: the program pf-localization, a process a run, with the options of `mcl`. It seeds
  itself, so its rows differ from run to run; its times are those it tells, by the clock.
)";
  return text.str();
}

struct WakeupSummary
{
  std::size_t runs = 0;
  std::size_t wrong_runs = 0;
  std::size_t wrong_mapped_runs = 0;  ///< of them, with a wrong step on mapped area
  std::size_t wrong_steps = 0;
  std::size_t wrong_episodes = 0;
  std::size_t steps = 0;
  Proportion right_at_end;
  Proportion settled;
  Proportion noticed;
  Quantiles distance_to_settled;
  Quantiles seconds_to_settled;
  Quantiles distance_to_noticed;
  Quantiles seconds_to_noticed;
  Quantiles cpu_to_settled;
  Quantiles step_ms;
};

/// Of the metres and of the seconds; those of logs without times are NaN.
std::pair<Quantiles, Quantiles> quantilesOfEvents(const std::vector<WakeupEvent>& events)
{
  std::vector<double> metres;
  std::vector<double> seconds;
  for (const WakeupEvent& event : events)
  {
    metres.push_back(event.metres);
    if (!std::isnan(event.seconds)) seconds.push_back(event.seconds);
  }
  return {quantilesOf(metres), quantilesOf(seconds)};
}

/// Of all runs, or of those of one group.
WakeupSummary summarizeRuns(const WakeupMethodReport& method, const std::string& group = {})
{
  WakeupSummary s;
  std::vector<WakeupEvent> settled;
  std::vector<WakeupEvent> noticed;
  std::vector<double> cpu;
  std::vector<double> times;
  for (const Wakeup& run : method.runs)
  {
    if (!group.empty() && run.group != group) continue;
    ++s.runs;
    ++s.right_at_end.cases;
    ++s.settled.cases;
    s.steps += run.steps.size();
    s.wrong_steps += run.wrong_steps;
    s.wrong_episodes += run.wrong_episodes;
    if (run.wrong_steps > 0) ++s.wrong_runs;
    if (run.wrong_mapped_steps > 0) ++s.wrong_mapped_runs;
    if (run.right_at_end) ++s.right_at_end.count;
    if (run.settled_after)
    {
      ++s.settled.count;
      settled.push_back(*run.settled_after);
    }
    if (run.kidnapped_at > 0)
    {
      ++s.noticed.cases;
      if (run.noticed_after)
      {
        ++s.noticed.count;
        noticed.push_back(*run.noticed_after);
      }
    }
    cpu.push_back(run.cpu_to_settled);
    for (const WakeupStep& step : run.steps) times.push_back(step.time_ms);
  }
  std::tie(s.distance_to_settled, s.seconds_to_settled) = quantilesOfEvents(settled);
  std::tie(s.distance_to_noticed, s.seconds_to_noticed) = quantilesOfEvents(noticed);
  s.cpu_to_settled = quantilesOf(cpu);
  s.step_ms = quantilesOf(times);
  return s;
}

/// Names of the groups that the runs belong to, if any.
std::set<std::string> groupsOf(const WakeupMethodReport& method)
{
  std::set<std::string> groups;
  for (const Wakeup& run : method.runs)
  {
    if (!run.group.empty()) groups.insert(run.group);
  }
  return groups;
}

/// What every sub-command's summary tells, of runs instead of queries: see definitions.
RelocationSummary endSummary(const WakeupMethodReport& method, const WakeupSummary& runs,
                             const AccuracyGates& gates)
{
  RelocationSummary s;
  std::vector<double> distances;
  std::vector<double> angles;
  s.queries = runs.runs;
  s.claims_verdict = true;
  s.confidently_wrong = runs.wrong_runs;
  s.time_ms = runs.step_ms;
  for (const Wakeup& run : method.runs)
  {
    s.saw_nothing += std::all_of(run.steps.begin(), run.steps.end(),
                                 [](const WakeupStep& step) { return step.saw_nothing; });
    const WakeupStep& last = run.steps[judgedStep(run).value_or(run.steps.size() - 1)];
    s.confident += last.claim.confident;
    s.confident_right += last.judged == Claim::right;
    s.inaccurate += last.judged == Claim::inaccurate;
    if (!judgedStep(run)) continue;
    const bool right = isRight(last.error, gates);
    const bool tight = right && last.error.angle_deg <= gates.tight_angle_deg;
    ++s.recall_at_1.cases;
    ++s.recall_at_1_tight.cases;
    s.recall_at_1.count += right;
    s.recall_at_1_tight.count += tight;
    if (!right) continue;
    distances.push_back(last.error.distance);
    angles.push_back(last.error.angle_deg);
  }
  s.median_error_m = quantilesOf(distances).median;
  s.median_error_deg = quantilesOf(angles).median;
  return s;
}

nlohmann::ordered_json methodJson(const WakeupMethodReport& method, const AccuracyGates& gates)
{
  const WakeupSummary s = summarizeRuns(method);
  nlohmann::ordered_json json = toJson(endSummary(method, s, gates));
  json["steps"] = s.steps;
  json["confidently_wrong_mapped"] = s.wrong_mapped_runs;
  json["confidently_wrong_steps"] = s.wrong_steps;
  json["confidently_wrong_episodes"] = s.wrong_episodes;
  addProportion(json, "right_at_end", s.right_at_end);
  addProportion(json, "settled", s.settled);
  json["distance_to_settled_m"] = toJson(s.distance_to_settled);
  json["time_to_settled_s"] = toJson(s.seconds_to_settled);
  json["cpu_s_to_settled"] = toJson(s.cpu_to_settled);
  json["step_ms"] = toJson(s.step_ms);
  addProportion(json, "noticed", s.noticed);
  json["noticed_after_m"] = toJson(s.distance_to_noticed);
  json["noticed_after_s"] = toJson(s.seconds_to_noticed);
  json["peak_rss_mb"] = method.peak_rss_mb;
  json["calibration"] = detail::toJson(detail::selfKnowledgeOf(method, gates));
  for (const std::string& group : groupsOf(method))
  {
    const WakeupSummary part = summarizeRuns(method, group);
    nlohmann::ordered_json& of_group = json["groups"][group];
    of_group["queries"] = part.runs;
    of_group["confidently_wrong"] = part.wrong_runs;
    addProportion(of_group, "right_at_end", part.right_at_end);
    of_group["distance_to_settled_m"] = toJson(part.distance_to_settled);
  }
  return json;
}

std::string resultsCsv(const WakeupReport& report)
{
  TextStream csv;
  csv << "method,start,step,travelled_m,seconds,kidnapped,confident,x,y,phi,error_m,error_deg,"
         "claim,"
         "verdict,hypotheses,weight,second_weight,elsewhere,nees,mapped,time_ms\n";
  for (const WakeupMethodReport& method : report.methods)
  {
    for (const Wakeup& run : method.runs)
    {
      for (std::size_t i = 0; i < run.steps.size(); ++i)
      {
        const WakeupStep& r = run.steps[i];
        const bool kidnapped = run.kidnapped_at > 0 && i >= run.kidnapped_at;
        csv << method.name << "," << run.start << "," << r.step << ","
            << fixedNumber(r.travelled, 3) << "," << fixedNumber(r.seconds, 3) << "," << kidnapped
            << "," << r.claim.confident << ",";
        if (r.claim.has_pose)
        {
          csv << fixedNumber(r.claim.pose.x, 4) << "," << fixedNumber(r.claim.pose.y, 4) << ","
              << fixedNumber(r.claim.pose.phi, 5);
        }
        else
        {
          csv << ",,";
        }
        csv << "," << fixedNumber(r.error.distance, 4) << "," << fixedNumber(r.error.angle_deg, 3)
            << "," << toString(r.judged) << ",";
        if (r.claim.belief)
        {
          csv << toString(r.claim.verdict) << "," << r.claim.hypotheses << ","
              << fixedNumber(r.claim.weights[0], 5) << "," << fixedNumber(r.claim.weights[1], 5)
              << "," << fixedNumber(r.claim.elsewhere, 5) << "," << fixedNumber(r.nees, 3);
        }
        else
        {
          csv << ",,,,,";
        }
        csv << "," << r.mapped << "," << fixedNumber(r.time_ms, 3) << "\n";
      }
    }
  }
  return csv.str();
}

std::string eventCells(const std::optional<WakeupEvent>& event)
{
  return event ? fixedNumber(event->metres, 3) + "," + fixedNumber(event->seconds, 3) : ",";
}

/// One row a run.
std::string runsCsv(const WakeupReport& report)
{
  TextStream csv;
  csv << "method,start,group,steps,right_at_end,settled_after_m,settled_after_s,wrong_steps,"
         "wrong_episodes,noticed_after_m,noticed_after_s\n";
  for (const WakeupMethodReport& method : report.methods)
  {
    for (const Wakeup& run : method.runs)
    {
      csv << method.name << "," << run.start << "," << run.group << "," << run.steps.size() << ","
          << run.right_at_end << "," << eventCells(run.settled_after) << "," << run.wrong_steps
          << "," << run.wrong_episodes << "," << eventCells(run.noticed_after) << "\n";
    }
  }
  return csv.str();
}

std::vector<std::pair<std::string, Plot>> plotsOf(const WakeupReport& report)
{
  Plot settled{"Distance driven until settled", "distance [m]", "share of runs", false, false, {}};
  Plot cpu{"CPU time until settled", "time [s]", "share of runs", true, false, {}};
  for (const WakeupMethodReport& method : report.methods)
  {
    std::vector<double> distances;
    std::vector<double> seconds;
    for (const Wakeup& run : method.runs)
    {
      if (!run.settled_after) continue;
      distances.push_back(run.settled_after->metres);
      seconds.push_back(run.cpu_to_settled);
    }
    settled.series.push_back(cumulativeShare(method.name, distances, method.runs.size()));
    cpu.series.push_back(cumulativeShare(method.name, seconds, method.runs.size()));
  }
  std::vector<std::pair<std::string, Plot>> plots = {{"settled.png", settled}, {"cpu.png", cpu}};
  for (const WakeupMethodReport& method : report.methods)
  {
    for (auto& plot : detail::beliefPlots(method)) plots.push_back(std::move(plot));
  }
  return plots;
}
/// What came after a kidnapping; empty without one.
std::string kidnappingTable(const WakeupReport& report)
{
  std::vector<std::vector<std::string>> rows = {{"after the kidnapping", "noticed", "m", "p95", "s",
                                                 "p95", "settled again", "m", "p95", "s", "p95",
                                                 "CPU s", "p95"}};
  for (const WakeupMethodReport& method : report.methods)
  {
    const WakeupSummary s = summarizeRuns(method);
    if (s.noticed.cases == 0) continue;
    std::vector<std::string> row = {method.name, withInterval(s.noticed)};
    const auto add = [&](const Quantiles& quantiles, int decimals)
    {
      row.push_back(fixedNumber(quantiles.median, decimals));
      row.push_back(fixedNumber(quantiles.p95, decimals));
    };
    add(s.distance_to_noticed, 2);
    add(s.seconds_to_noticed, 1);
    row.push_back(withInterval(s.settled));
    add(s.distance_to_settled, 2);
    add(s.seconds_to_settled, 1);
    add(s.cpu_to_settled, 3);
    rows.push_back(row);
  }
  return rows.size() > 1 ? "\n" + markdownTable(rows) : std::string();
}
}  // namespace

std::string wakeupTable(const WakeupReport& report)
{
  std::vector<std::vector<std::string>> rows = {
      {"method", "runs", "right at end", "settled", "wrong runs", "of them mapped", "wrong steps",
       "episodes", "m to settle", "p95", "CPU s to settle", "p95", "step ms", "p95", "noticed"}};
  const auto add = [&](const std::string& name, const WakeupSummary& s)
  {
    rows.push_back(
        {name, std::to_string(s.runs), withInterval(s.right_at_end), withInterval(s.settled),
         std::to_string(s.wrong_runs), std::to_string(s.wrong_mapped_runs),
         std::to_string(s.wrong_steps), std::to_string(s.wrong_episodes),
         fixedNumber(s.distance_to_settled.median, 2), fixedNumber(s.distance_to_settled.p95, 2),
         fixedNumber(s.cpu_to_settled.median, 3), fixedNumber(s.cpu_to_settled.p95, 3),
         fixedNumber(s.step_ms.median, 2), fixedNumber(s.step_ms.p95, 2), withInterval(s.noticed)});
  };
  for (const WakeupMethodReport& method : report.methods)
  {
    add(method.name, summarizeRuns(method));
    for (const std::string& group : groupsOf(method))
    {
      add(method.name + ", " + group, summarizeRuns(method, group));
    }
  }
  return markdownTable(rows) + kidnappingTable(report);
}

void writeWakeupReport(const WakeupReport& report, const std::filesystem::path& folder)
{
  RunReport files;
  for (const WakeupMethodReport& method : report.methods)
  {
    files.summary["methods"][method.name] = methodJson(method, report.gates);
  }
  files.summary["map"] = toJson(report.map);
  files.summary["complete"] = report.complete;
  files.results = resultsCsv(report);
  files.text = "# Wake-ups\n\n" + wakeupTable(report);
  if (report.foreign)
    files.text += "\nThe map is of another place: every confident step is wrong.\n";
  for (const WakeupMethodReport& method : report.methods)
  {
    const std::string tables = detail::toMarkdown(detail::selfKnowledgeOf(method, report.gates));
    if (tables.empty()) continue;
    files.text += "\n## What the weights of `" + method.name + "` are worth\n\n" + tables;
  }
  files.tables = {{"runs.csv", runsCsv(report)}};
  files.plots = plotsOf(report);
  files.notes = definitions(report.gates) + mapSection(report.map);
  files.provenance = report.provenance;
  writeRunReport(files, folder);
}
}  // namespace sigloc
