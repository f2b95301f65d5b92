// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <set>

#include "eval/reports/report_files.h"
#include "eval/reports/wakeup_calibration.h"
#include "eval/scoring/relocation_summary.h"
#include "eval/wakeup/wakeup.h"

namespace sigloc
{
namespace
{
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

constexpr const char* kWakeupNotes = R"(
* Confident: for `signature` and `signature-mcl` the verdict `localized`; for MRPT's filter a position sd below 0.5 m
  and a heading sd below 10 degrees over 5 steps.
* `signature-mcl`: MRPT's filter with 500 particles, drawn where signatures find a lost robot.
* `mcl`: MRPT's filter with pf-localization's shipped options (KLD, 40 000 particles at first), driven
  as that program does: its map, the log's own model of the motion, no update at the first step.
  `mcl-fixed`: 40 000 throughout. `mcl-tuned`: 200 particles per free square metre, between 40 000 and
  200 000, KLD down to 1 000 on cells of 0.5 m, motion noise of at least 5 cm and 2 degrees a step.
  `mcl-best`: the same with all beams, their likelihood tempered; it is confident only where MRPT's own
  reliability of the scan is high enough, too. Both numbers were chosen on aces. One thread each.
* `mcl-stock`: the program pf-localization, a process a run, with the options of `mcl`. It seeds
  itself, so its rows differ from run to run; its times are those it tells, by the clock.
)";

/// What counts as right and as wrong, claims being judged by these gates.
std::string judgement(const AccuracyGates& gates)
{
  return fmt::format(R"(
* A run wakes up lost at one place and drives on. Right: within {} m and {} degrees of the truth.
  Wrong: more than {} m or {} degrees off.
* Mapped: the truth is within 1 m of a mapped pose. A run is judged at its last mapped step with truth.
* After a kidnapping way, time and CPU time count from there, and no run has settled before it
  noticed. Times *s* are those of the drive, by the log.
* In `summary.json`, `confident`, `confident_right` and `inaccurate` count runs by the step that they
  are judged at, `confidently_wrong` those that were wrong at any step. `recall_at_1` is the share
  whose best pose is right at that step, sure or not. A run that saw nothing has fewer than 10 beams
  in every step.
)",
                     gates.right_distance, mrpt::RAD2DEG(gates.right_angle), gates.wrong_distance,
                     mrpt::RAD2DEG(gates.wrong_angle));
}

/// The runs of a method, or those of one group.
struct WakeupSummary
{
  std::string name;
  std::vector<std::reference_wrapper<const Wakeup>> records;
};

WakeupSummary summaryOf(const WakeupMethodReport& method, const std::string& group = {})
{
  WakeupSummary summary{method.name + (group.empty() ? "" : ", " + group), {}};
  for (const Wakeup& run : method.runs)
    if (group.empty() || run.group == group) summary.records.emplace_back(run);
  return summary;
}

bool isWrong(const Wakeup& run)
{
  return run.wrong_steps > 0;
}

bool hasSettled(const Wakeup& run)
{
  return run.settled_after.has_value();
}

/// None without a kidnapping.
std::optional<bool> hasNoticed(const Wakeup& run)
{
  return run.kidnapped_at > 0 ? std::optional(run.noticed_after.has_value()) : std::nullopt;
}

/// A part of an event, NaN where it never came.
auto at(std::optional<WakeupEvent> Wakeup::*event, double WakeupEvent::*part)
{
  return [event, part](const Wakeup& run) {
    return (run.*event).value_or(WakeupEvent{kNone, kNone}).*part;
  };
}

double cpuWhereSettled(const Wakeup& run)
{
  return run.settled_after ? run.cpu_to_settled : kNone;
}

std::vector<double> stepTimes(const Wakeup& run)
{
  std::vector<double> times;
  for (const WakeupStep& step : run.steps) times.push_back(step.time_ms);
  return times;
}

/// What summary.json holds of a method beside what every sub-command has, and the table.
Columns<WakeupSummary> wakeupColumns()
{
  using C = Column<WakeupSummary>;
  using W = Wakeup;
  using E = WakeupEvent;
  constexpr int kWrong = 1, kCosts = 2;
  return {
      C("", &WakeupSummary::name, "", 0, {"method"}),
      C("", [](const WakeupSummary& s) { return s.records.size(); }, "", 0, {"runs"}),
      C("", total(isWrong), "runs with a step that is confident and wrong", 0, {"wrong runs"},
        kWrong),
      C("steps", total([](const W& run) { return run.steps.size(); }), "of all runs"),
      C("confidently_wrong_mapped", total([](const W& run) { return run.wrong_mapped_steps > 0; }),
        "runs with such a step where mapped; the others claimed a pose from off the mapped area", 0,
        {"of them mapped"}, kWrong),
      C("confidently_wrong_steps", total(&W::wrong_steps), "steps that are confident and wrong", 0,
        {"wrong steps"}, kWrong),
      C("confidently_wrong_episodes", total(&W::wrong_episodes), "unbroken stretches of them", 0,
        {"episodes"}, kWrong),
      C("right_at_end", share(&W::right_at_end),
        "confident and right at the step that the run is judged at", 0, {"right at end"}),
      C("settled", share(hasSettled),
        "confident from some step to the end, steps off the mapped area aside", 0, {"settled"}),
      C("distance_to_settled_m", quantiles(at(&W::settled_after, &E::metres)),
        "driven until then, of the runs that settle", 2, {"m to settle", "p95"}, kCosts),
      C("time_to_settled_s", quantiles(at(&W::settled_after, &E::seconds)),
        "of the drive until then, of the runs that settle"),
      C("cpu_s_to_settled", quantiles(&W::cpu_to_settled),
        "CPU time until then, building the filter included; all of a run that never settles", 3,
        {"CPU s to settle", "p95"}, kCosts),
      C("step_ms", quantiles(stepTimes), "CPU time of a step", 2, {"step ms", "p95"}, kCosts),
      C("noticed", share(hasNoticed),
        "after a kidnapping, runs in which the method was not, or no longer, sure of a wrong pose",
        0, {"noticed"}, kCosts),
      C("noticed_after_m", quantiles(at(&W::noticed_after, &E::metres)),
        "driven from the kidnapping until then"),
      C("noticed_after_s", quantiles(at(&W::noticed_after, &E::seconds)),
        "time from the kidnapping until then")};
}

/// What came after a kidnapping, as a table.
Columns<WakeupSummary> kidnappingColumns()
{
  using C = Column<WakeupSummary>;
  using W = Wakeup;
  using E = WakeupEvent;
  return {C("", &WakeupSummary::name, "", 0, {"after the kidnapping"}),
          C("", share(hasNoticed), "", 0, {"noticed"}),
          C("", quantiles(at(&W::noticed_after, &E::metres)), "", 2, {"m", "p95"}),
          C("", quantiles(at(&W::noticed_after, &E::seconds)), "", 1, {"s", "p95"}),
          C("", share(hasSettled), "", 0, {"settled again"}),
          C("", quantiles(at(&W::settled_after, &E::metres)), "", 2, {"m", "p95"}),
          C("", quantiles(at(&W::settled_after, &E::seconds)), "", 1, {"s", "p95"}),
          C("", quantiles(&W::cpu_to_settled), "", 3, {"CPU s", "p95"})};
}

/// Names of the groups that the runs belong to, if any.
std::set<std::string> groupsOf(const WakeupMethodReport& method)
{
  std::set<std::string> groups;
  for (const Wakeup& run : method.runs)
    if (!run.group.empty()) groups.insert(run.group);
  return groups;
}

/// What every sub-command's summary holds, of runs instead of queries: see judgement.
RelocationSummary endSummary(const WakeupMethodReport& method, const AccuracyGates& gates)
{
  RelocationSummary summary{method.name, {}};
  for (const Wakeup& run : method.runs)
  {
    Outcome& outcome = summary.records.emplace_back();
    outcome.times_ms = stepTimes(run);
    outcome.saw_nothing = std::all_of(run.steps.begin(), run.steps.end(),
                                      [](const WakeupStep& step) { return step.saw_nothing; });
    const WakeupStep& last = run.steps[judgedStep(run).value_or(run.steps.size() - 1)];
    outcome.claims_verdict = true;
    outcome.confident = last.claim.confident;
    outcome.confident_right = last.judged == Claim::right;
    outcome.confidently_wrong = isWrong(run);
    outcome.inaccurate = last.judged == Claim::inaccurate;
    if (!judgedStep(run)) continue;
    outcome.right = isRight(last.error, gates);
    outcome.tight = *outcome.right && last.error.angle <= gates.tight_angle;
    if (*outcome.right) outcome.error = last.error;
  }
  return summary;
}

nlohmann::ordered_json methodJson(const WakeupMethodReport& method, const AccuracyGates& gates)
{
  nlohmann::ordered_json json = toJson(summaryColumns(), endSummary(method, gates));
  json.update(toJson(wakeupColumns(), summaryOf(method)));
  json["peak_rss_mb"] = method.peak_rss_mb;
  json["calibration"] = detail::toJson(detail::selfKnowledgeOf(method, gates));
  for (const std::string& group : groupsOf(method))
  {
    const WakeupSummary part = summaryOf(method, group);
    const nlohmann::ordered_json all = toJson(wakeupColumns(), part);
    nlohmann::ordered_json& of_group = json["groups"][group];
    of_group["queries"] = part.records.size();
    of_group["confidently_wrong"] = total(isWrong)(part);
    for (const char* key :
         {"right_at_end", "right_at_end_counts", "right_at_end_interval", "distance_to_settled_m"})
      of_group[key] = all.at(key);
  }
  return json;
}

std::vector<std::pair<std::string, Plot>> plotsOf(const WakeupReport& report)
{
  Plot settled{"Distance driven until settled", "distance [m]", "share of runs", false, false, {}};
  Plot cpu{"CPU time until settled", "time [s]", "share of runs", true, false, {}};
  for (const WakeupMethodReport& method : report.methods)
  {
    const WakeupSummary runs = summaryOf(method);
    const auto metres = values(at(&Wakeup::settled_after, &WakeupEvent::metres))(runs);
    const auto seconds = values(cpuWhereSettled)(runs);
    settled.series.push_back(cumulativeShare(method.name, metres, method.runs.size()));
    cpu.series.push_back(cumulativeShare(method.name, seconds, method.runs.size()));
  }
  std::vector<std::pair<std::string, Plot>> plots = {{"settled.png", settled}, {"cpu.png", cpu}};
  for (const WakeupMethodReport& method : report.methods)
    for (auto& plot : detail::beliefPlots(method)) plots.push_back(std::move(plot));
  return plots;
}

/// What came after a kidnapping; empty without one.
std::string kidnappingTable(const WakeupReport& report)
{
  std::vector<std::vector<std::string>> rows = {tableHead(kidnappingColumns())};
  for (const WakeupMethodReport& method : report.methods)
  {
    const WakeupSummary summary = summaryOf(method);
    if (share(hasNoticed)(summary).cases == 0) continue;
    rows.push_back(tableRow(kidnappingColumns(), summary));
  }
  return rows.size() > 1 ? "\n" + markdownTable(rows) : std::string();
}
/// What became of a run: a wrong claim at any step counts more than how it ended.
PageOutcome outcomeOf(const Wakeup& run, const AccuracyGates& gates)
{
  if (run.wrong_steps > 0) return PageOutcome::claimed_wrong;
  const auto judged = judgedStep(run);
  if (!judged) return PageOutcome::not_right;
  const WakeupStep& last = run.steps[*judged];
  return pageOutcome(isRight(last.error, gates), last.judged);
}

PagePlace pagePlace(const std::string& method, const Wakeup& run, const AccuracyGates& gates)
{
  PagePlace place;
  place.method = method;
  place.name = fmt::format("start {}", run.start);
  place.outcome = outcomeOf(run, gates);
  for (const WakeupStep& step : run.steps)
  {
    if (!step.claim.has_pose) continue;
    place.path.emplace_back(step.claim.pose, step.judged);
    place.first = step.claim.pose;
  }
  place.facts = {
      {"steps", std::to_string(run.steps.size())},
      {"right at the end", run.right_at_end ? "yes" : "no"},
      {"settled after", run.settled_after ? fmt::format("{:.1f} m", run.settled_after->metres)
                                          : std::string("never")},
      {"wrong claims", fmt::format("{} steps", run.wrong_steps)}};
  return place;
}

PageMap pageOf(const WakeupReport& report)
{
  PageMap page;
  page.map = report.features;
  for (const WakeupMethodReport& method : report.methods)
  {
    for (const Wakeup& run : method.runs)
      page.places.push_back(pagePlace(method.name, run, report.gates));
  }
  return page;
}
}  // namespace

std::string wakeupTable(const WakeupReport& report)
{
  std::vector<std::vector<std::string>> rows = {tableHead(wakeupColumns())};
  for (const WakeupMethodReport& method : report.methods)
  {
    rows.push_back(tableRow(wakeupColumns(), summaryOf(method)));
    for (const std::string& group : groupsOf(method))
      rows.push_back(tableRow(wakeupColumns(), summaryOf(method, group)));
  }
  return markdownTable(rows) + kidnappingTable(report);
}

void writeWakeupReport(const WakeupReport& report, const std::filesystem::path& folder)
{
  RunReport files;
  for (const WakeupMethodReport& method : report.methods)
    files.summary["methods"][method.name] = methodJson(method, report.gates);
  files.summary["map"] = toJson(mapColumns(), report.map);
  files.summary["complete"] = report.complete;
  files.results = "method,start," + csvHead(stepColumns()) + "\n";
  std::string runs = "method," + csvHead(runColumns()) + "\n";
  for (const WakeupMethodReport& method : report.methods)
  {
    for (const Wakeup& run : method.runs)
    {
      const std::string start = method.name + "," + std::to_string(run.start) + ",";
      for (const WakeupStep& step : run.steps)
        files.results += start + csvRow(stepColumns(), step) + "\n";
      runs += method.name + "," + csvRow(runColumns(), run) + "\n";
    }
  }
  files.text = "# Wake-ups\n\n" + wakeupTable(report);
  if (report.foreign)
    files.text += "\nThe map is of another place: every confident step is wrong.\n";
  for (const WakeupMethodReport& method : report.methods)
  {
    const std::string tables = detail::toMarkdown(detail::selfKnowledgeOf(method, report.gates));
    if (tables.empty()) continue;
    files.text += "\n## What the weights of `" + method.name + "` are worth\n\n" + tables;
  }
  files.tables = {{"runs.csv", runs}};
  files.plots = plotsOf(report);
  files.notes = legend("What the columns mean", wakeupColumns()) + judgement(report.gates) +
                kWakeupNotes + legend("What the columns of runs.csv mean", runColumns()) +
                legend("What the columns of results.csv mean", stepColumns()) +
                mapSection(report.map);
  files.page = pageOf(report);
  files.provenance = report.provenance;
  writeRunReport(files, folder);
}
}  // namespace sigloc
