// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "sigloc/eval/report_files.h"
#include "sigloc/eval/track.h"
#include "track_calibration.h"

namespace sigloc
{
namespace
{
constexpr const char* kDefinitions = R"(
## What the columns mean

* A run wakes up lost at one place and drives on. **right at end**: confident and within 0.5 m and
  10 degrees of the truth at the last step with truth. **settled**: confident from some step to the
  end; the distance to it is over the runs that settle, the CPU time (building the filter included)
  over all: a run that never settles costs its whole time.
* **wrong**: runs with a step that is confident and more than 1 m or 20 degrees off; steps and
  unbroken episodes of it counted as well.
* **noticed**: after a kidnapping, runs in which the method stopped being sure of a wrong place.
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

struct TrackSummary
{
  std::size_t runs = 0;
  std::size_t wrong_runs = 0;
  std::size_t wrong_steps = 0;
  std::size_t wrong_episodes = 0;
  std::size_t steps = 0;
  Proportion right_at_end;
  Proportion settled;
  Proportion noticed;
  Quantiles distance_to_settled;
  Quantiles noticed_after;
  Quantiles cpu_to_settled;
  Quantiles step_ms;
};

/// Of all runs, or of those of one group.
TrackSummary summarizeRuns(const TrackMethodReport& method, const std::string& group = {})
{
  TrackSummary s;
  std::vector<double> distances;
  std::vector<double> noticed;
  std::vector<double> cpu;
  std::vector<double> times;
  for (const TrackRun& run : method.runs)
  {
    if (!group.empty() && run.group != group) continue;
    ++s.runs;
    ++s.right_at_end.cases;
    ++s.settled.cases;
    s.steps += run.steps.size();
    s.wrong_steps += run.wrong_steps;
    s.wrong_episodes += run.wrong_episodes;
    if (run.wrong_steps > 0) ++s.wrong_runs;
    if (run.right_at_end) ++s.right_at_end.count;
    if (run.settled_after)
    {
      ++s.settled.count;
      distances.push_back(*run.settled_after);
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
    for (const TrackStepRecord& step : run.steps) times.push_back(step.time_ms);
  }
  s.distance_to_settled = quantilesOf(distances);
  s.noticed_after = quantilesOf(noticed);
  s.cpu_to_settled = quantilesOf(cpu);
  s.step_ms = quantilesOf(times);
  return s;
}

/// Names of the groups that the runs belong to, if any.
std::set<std::string> groupsOf(const TrackMethodReport& method)
{
  std::set<std::string> groups;
  for (const TrackRun& run : method.runs)
  {
    if (!run.group.empty()) groups.insert(run.group);
  }
  return groups;
}

nlohmann::ordered_json methodJson(const TrackMethodReport& method)
{
  const TrackSummary s = summarizeRuns(method);
  nlohmann::ordered_json json;
  json["queries"] = s.runs;
  json["steps"] = s.steps;
  json["confidently_wrong"] = s.wrong_runs;
  json["confidently_wrong_steps"] = s.wrong_steps;
  json["confidently_wrong_episodes"] = s.wrong_episodes;
  addProportion(json, "right_at_end", s.right_at_end);
  addProportion(json, "settled", s.settled);
  json["distance_to_settled_m"] = toJson(s.distance_to_settled);
  json["cpu_s_to_settled"] = toJson(s.cpu_to_settled);
  json["step_ms"] = toJson(s.step_ms);
  addProportion(json, "noticed", s.noticed);
  json["noticed_after_m"] = toJson(s.noticed_after);
  json["peak_rss_mb"] = method.peak_rss_mb;
  json["calibration"] = detail::toJson(detail::selfKnowledgeOf(method, {}));
  for (const std::string& group : groupsOf(method))
  {
    const TrackSummary part = summarizeRuns(method, group);
    nlohmann::ordered_json& of_group = json["groups"][group];
    of_group["queries"] = part.runs;
    of_group["confidently_wrong"] = part.wrong_runs;
    addProportion(of_group, "right_at_end", part.right_at_end);
    of_group["distance_to_settled_m"] = toJson(part.distance_to_settled);
  }
  return json;
}

std::string resultsCsv(const TrackReport& report)
{
  std::ostringstream csv;
  csv << "method,start,step,travelled_m,kidnapped,confident,x,y,phi,error_m,error_deg,claim,"
         "verdict,hypotheses,weight,second_weight,elsewhere,nees,mapped,time_ms\n";
  for (const TrackMethodReport& method : report.methods)
  {
    for (const TrackRun& run : method.runs)
    {
      for (std::size_t i = 0; i < run.steps.size(); ++i)
      {
        const TrackStepRecord& r = run.steps[i];
        const bool kidnapped = run.kidnapped_at > 0 && i >= run.kidnapped_at;
        csv << method.name << "," << run.start << "," << r.step << ","
            << fixedNumber(r.travelled, 3) << "," << kidnapped << "," << r.claim.confident << ",";
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

/// One row a run.
std::string runsCsv(const TrackReport& report)
{
  std::ostringstream csv;
  csv << "method,start,group,steps,right_at_end,settled_after_m,wrong_steps,wrong_episodes,"
         "noticed_after_m\n";
  for (const TrackMethodReport& method : report.methods)
  {
    for (const TrackRun& run : method.runs)
    {
      constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
      csv << method.name << "," << run.start << "," << run.group << "," << run.steps.size() << ","
          << run.right_at_end << "," << fixedNumber(run.settled_after.value_or(kNone), 3) << ","
          << run.wrong_steps << "," << run.wrong_episodes << ","
          << fixedNumber(run.noticed_after.value_or(kNone), 3) << "\n";
    }
  }
  return csv.str();
}

std::vector<std::pair<std::string, Plot>> plotsOf(const TrackReport& report)
{
  Plot settled{"Distance driven until settled", "distance [m]", "share of runs", false, false, {}};
  Plot cpu{"CPU time until settled", "time [s]", "share of runs", true, false, {}};
  for (const TrackMethodReport& method : report.methods)
  {
    std::vector<double> distances;
    std::vector<double> seconds;
    for (const TrackRun& run : method.runs)
    {
      if (!run.settled_after) continue;
      distances.push_back(*run.settled_after);
      seconds.push_back(run.cpu_to_settled);
    }
    settled.series.push_back(cumulativeShare(method.name, distances, method.runs.size()));
    cpu.series.push_back(cumulativeShare(method.name, seconds, method.runs.size()));
  }
  std::vector<std::pair<std::string, Plot>> plots = {{"settled.png", settled}, {"cpu.png", cpu}};
  for (const TrackMethodReport& method : report.methods)
  {
    for (auto& plot : detail::beliefPlots(method)) plots.push_back(std::move(plot));
  }
  return plots;
}
}  // namespace

std::string trackTable(const TrackReport& report)
{
  std::vector<std::vector<std::string>> rows = {
      {"method", "runs", "right at end", "settled", "wrong runs", "wrong steps", "episodes",
       "m to settle", "p95", "CPU s to settle", "p95", "step ms", "p95", "noticed"}};
  const auto add = [&](const std::string& name, const TrackSummary& s)
  {
    rows.push_back(
        {name, std::to_string(s.runs), withInterval(s.right_at_end), withInterval(s.settled),
         std::to_string(s.wrong_runs), std::to_string(s.wrong_steps),
         std::to_string(s.wrong_episodes), fixedNumber(s.distance_to_settled.median, 2),
         fixedNumber(s.distance_to_settled.p95, 2), fixedNumber(s.cpu_to_settled.median, 3),
         fixedNumber(s.cpu_to_settled.p95, 3), fixedNumber(s.step_ms.median, 2),
         fixedNumber(s.step_ms.p95, 2), withInterval(s.noticed)});
  };
  for (const TrackMethodReport& method : report.methods)
  {
    add(method.name, summarizeRuns(method));
    for (const std::string& group : groupsOf(method))
    {
      add(method.name + ", " + group, summarizeRuns(method, group));
    }
  }
  return markdownTable(rows);
}

void writeTrackReport(const TrackReport& report, const std::filesystem::path& folder)
{
  RunReport files;
  for (const TrackMethodReport& method : report.methods)
  {
    files.summary["methods"][method.name] = methodJson(method);
  }
  files.summary["map"] = {{"features", report.map_features}, {"build_s", report.map_build_seconds}};
  files.summary["complete"] = report.complete;
  files.results = resultsCsv(report);
  files.text = "# Wake-ups\n\n" + trackTable(report);
  for (const TrackMethodReport& method : report.methods)
  {
    const std::string tables = detail::toMarkdown(detail::selfKnowledgeOf(method, {}));
    if (tables.empty()) continue;
    files.text += "\n## What the weights of `" + method.name + "` are worth\n\n" + tables;
  }
  files.tables = {{"runs.csv", runsCsv(report)}};
  files.plots = plotsOf(report);
  files.notes = kDefinitions;
  files.provenance = report.provenance;
  writeRunReport(files, folder);
}
}  // namespace sigloc
