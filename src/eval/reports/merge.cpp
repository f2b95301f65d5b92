// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/reports/merge.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "eval/data/csv_table.h"
#include "eval/reports/sweep_report.h"
#include "eval/scoring/relocation_summary.h"
#include "io/archive/gzip_input.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using detail::CsvTable;
using nlohmann::ordered_json;

/// What summary.json tells of a run.
struct RunSummary
{
  ordered_json methods;  ///< an object of each, by name
  bool complete = true;
  std::string command;
  std::string label;  ///< of what a sweep varies
  std::string data;  ///< checksums of its data or, in simulation, its seed
};

/// What one run left in its folder.
struct Run
{
  fs::path folder;
  RunSummary summary;
  CsvTable results;

  std::vector<std::string> methods() const
  {
    std::vector<std::string> names;
    for (const auto& [name, method] : summary.methods.items()) names.push_back(name);
    return names;
  }
};

constexpr const char* kCounts = "_counts";  // of the cases and of all, behind the name of a share

bool isMethod(const ordered_json& method)
{
  if (!method.is_object()) return false;
  for (const auto& [key, value] : method.items())
  {
    const auto counts = method.find(key + kCounts);
    if (counts != method.end() && (counts->size() != 2 || !counts->front().is_number_unsigned() ||
                                   !counts->back().is_number_unsigned()))
    {
      return false;
    }
    const bool is_count = key == "confidently_wrong" || key == "queries";
    if (is_count && !value.is_number_unsigned()) return false;
  }
  return true;
}

/// Returns nullopt where a value is missing or has another type.
std::optional<RunSummary> summaryOf(const ordered_json& json)
try
{
  RunSummary summary;
  summary.methods = json.at("methods");
  if (!summary.methods.is_object() ||
      !std::all_of(summary.methods.begin(), summary.methods.end(), isMethod))
  {
    return std::nullopt;
  }
  summary.complete = json.value("complete", true);
  summary.label = json.value("label", "");
  const ordered_json& provenance = json.at("provenance");
  summary.command = provenance.value("command", "");
  const auto data = provenance.value("data", ordered_json::array());
  for (const auto& file : data) summary.data += " " + file.value("md5", "");
  if (data.empty()) summary.data = provenance.value("seed", ordered_json()).dump();
  return summary;
}
catch (const ordered_json::exception&)
{
  return std::nullopt;
}

/// A file that was cut off at the end of a line looks whole.
void checkComplete(const Run& run)
{
  // A row is a query, or a step of a drive; elsewhere it sums many up.
  if (!run.results.has("query") && !run.results.has("step")) return;
  std::map<std::string, std::size_t> rows;
  for (std::size_t i = 0; i < run.results.rows(); ++i) ++rows[run.results.text(i, "method")];
  for (const auto& [name, method] : run.summary.methods.items())
  {
    const std::string counted = method.contains("steps") ? "steps" : "queries";
    const auto expected = method.find(counted);
    if (expected == method.end() || !expected->is_number_unsigned()) continue;
    if (rows[name] == expected->get<std::size_t>()) continue;
    throw std::runtime_error(
        fmt::format("{}: holds {} rows of {}, not the {} {} that summary.json counts",
                    (run.folder / "results.csv").string(), rows[name], name,
                    expected->get<std::size_t>(), counted));
  }
}

Run readRun(const fs::path& folder)
{
  const fs::path path = folder / "summary.json";
  detail::requireFile(path);
  std::ifstream file(path);
  std::optional<RunSummary> summary = summaryOf(ordered_json::parse(file, nullptr, false));
  if (!summary) throw std::runtime_error(path.string() + ": is no summary of sigloc-eval");
  Run run{folder, std::move(*summary), CsvTable(folder / "results.csv")};
  checkComplete(run);
  return run;
}

/// What a run asked: its data, and the columns that tell a question. Another seed asks a log
/// nothing new.
std::set<std::string> questionsOf(const Run& run)
{
  // The world of a sweep has the seed in its name, and keeps it when merged.
  const std::string asked = run.results.has("world") ? "" : run.summary.data;
  std::set<std::string> questions;
  for (std::size_t i = 0; i < run.results.rows(); ++i)
  {
    std::string question = asked;
    for (const char* column : {"run", "over", "value", "world", "start", "query"})
    {
      if (run.results.has(column)) question += " " + run.results.text(i, column);
    }
    questions.insert(question);
  }
  return questions;
}

/// A share is comparable only where every method was asked everything.
void checkAlike(const std::vector<Run>& runs)
{
  std::set<fs::path> seen;
  std::set<std::string> asked;
  for (const Run& run : runs)
  {
    if (!seen.insert(fs::canonical(run.folder)).second)
    {
      throw std::runtime_error(run.folder.string() + ": given twice");
    }
    if (run.methods() != runs.front().methods())
    {
      throw std::runtime_error(run.folder.string() + ": has other methods than " +
                               runs.front().folder.string());
    }
    for (const std::string& question : questionsOf(run))
    {
      if (asked.insert(question).second) continue;
      throw std::runtime_error(run.folder.string() +
                               ": an earlier run asked the same: give each run data of its own or, "
                               "in simulation, a --seed");
    }
  }
}

/// The command of each run, into report and summary.
void addRuns(const std::vector<Run>& runs, RunReport& report)
{
  std::vector<std::vector<std::string>> rows = {{"run", "command"}};
  for (const Run& run : runs)
  {
    rows.push_back({run.folder.string(), run.summary.command});
    report.summary["runs"].push_back(
        {{"folder", run.folder.string()}, {"command", run.summary.command}});
  }
  report.text += "\n## The runs\n\n" + markdownTable(rows);
}

// relocate

/// A method in one of the runs.
struct SummaryOfRun : RelocationSummary
{
  std::string run;
};

RunReport mergeRelocations(const std::vector<Run>& runs)
{
  RunReport report;
  report.results = "run,method," + csvHead(relocationColumns()) + "\n";
  std::vector<SummaryOfRun> by_run;
  std::vector<RelocationSummary> pooled;
  for (const std::string& method : runs.front().methods()) pooled.push_back({method, {}});
  for (const Run& run : runs)
  {
    std::map<std::string, std::vector<RelocationRecord>> records;
    for (std::size_t i = 0; i < run.results.rows(); ++i)
      records[run.results.text(i, "method")].push_back(storedRelocation(run.results, i));
    const std::size_t first = by_run.size();
    for (RelocationSummary& all : pooled)
    {
      SummaryOfRun& own = by_run.emplace_back(SummaryOfRun{{all.method, {}}, run.folder.string()});
      for (const RelocationRecord& record : records[all.method])
      {
        own.add(record);
        all.add(record);
        report.results += fmt::format("{},{},{}\n", detail::csvCell(own.run), all.method,
                                      csvRow(relocationColumns(), record));
      }
      own.reference_ms = medianTime(by_run[first]);
    }
  }
  for (RelocationSummary& all : pooled)
  {
    all.reference_ms = medianTime(pooled.front());
    report.summary["methods"][all.method] = toJson(summaryColumns(), all);
  }
  Columns<SummaryOfRun> columns = {{"", &SummaryOfRun::run, "", 0, {"run"}}};
  for (const auto& column : summaryColumns()) columns.emplace_back(column);
  report.text = "# Relocation from one scan, " + std::to_string(runs.size()) + " runs\n\n" +
                markdownTable(table(summaryColumns(), pooled)) + "\n## Run by run\n\n" +
                markdownTable(table(columns, by_run));
  report.notes = relocationDefinitions();
  return report;
}

// sweep

SweepRow& rowOf(SweepReport& report, double value, const std::string& method)
{
  for (SweepRow& row : report.rows)
  {
    if (row.value == value && row.method == method) return row;
  }
  report.rows.push_back({value, method, {}, {}});
  return report.rows.back();
}

void addSweepRun(const Run& run, SweepReport& report)
{
  for (std::size_t i = 0; i < run.results.rows(); ++i)
  {
    const std::string& world = run.results.text(i, "world");
    const std::string& method = run.results.text(i, "method");
    if (run.results.text(i, "over") != report.over)
    {
      run.results.fail(
          i, "a sweep over '" + run.results.text(i, "over") + "', not over '" + report.over + "'");
    }
    rowOf(report, run.results.number(i, "value"), method)
        .records.push_back({world, storedRelocation(run.results, i)});
  }
}

RunReport mergeSweeps(const std::vector<Run>& runs)
{
  SweepReport report;
  report.over = runs.front().results.text(0, "over");
  report.label = runs.front().summary.label;
  if (report.label.empty()) report.label = report.over;
  for (const Run& run : runs) addSweepRun(run, report);
  std::stable_sort(report.rows.begin(), report.rows.end(),
                   [](const SweepRow& a, const SweepRow& b) { return a.value < b.value; });
  return sweepRunReport(report);
}

// track

/// Sums a method's counts and computes its shares anew, into JSON and a row of a table. All else of
/// its summary cannot be summed.
void sumCounts(const std::vector<Run>& runs, const std::string& method, ordered_json& sum,
               std::vector<Cells>& table)
{
  sum = ordered_json::object();
  std::map<std::string, Proportion> shares;
  for (const Run& run : runs)
  {
    const ordered_json& summary = run.summary.methods.at(method);
    for (const auto& [key, value] : summary.items())
    {
      if (value.is_number_unsigned())
        sum[key] = sum.value(key, std::uint64_t{0}) + value.get<std::uint64_t>();
      if (!summary.contains(key + kCounts)) continue;
      const auto& counts = summary.at(key + kCounts);
      shares[key].count += counts.at(0).get<std::size_t>();
      shares[key].cases += counts.at(1).get<std::size_t>();
    }
  }
  Cells head = {"method"};
  Cells cells = {method};
  for (const auto& [key, value] : sum.items())
  {
    head.push_back(key);
    cells.push_back(value.dump());
  }
  for (const auto& [name, share] : shares)
  {
    addJson(sum, name, share);
    head.push_back(name);
    cells.push_back(withInterval(share));
  }
  if (table.empty()) table.push_back(head);
  table.push_back(cells);
}

RunReport mergeDrives(const std::vector<Run>& runs)
{
  RunReport report;
  std::vector<Cells> table;
  for (const std::string& method : runs.front().methods())
    sumCounts(runs, method, report.summary["methods"][method], table);
  report.results = "run,method,confidently_wrong,queries\n";
  for (const Run& run : runs)
  {
    for (const auto& [name, method] : run.summary.methods.items())
    {
      report.results +=
          fmt::format("{},{},{},{}\n", detail::csvCell(run.folder.string()), name,
                      method.value("confidently_wrong", 0), method.value("queries", 0));
    }
  }
  report.text = "# Wake-ups, " + std::to_string(runs.size()) + " runs\n\n" + markdownTable(table);
  return report;
}

RunReport pool(const std::vector<Run>& runs)
{
  const auto all_have = [&](const char* column)
  {
    return std::all_of(runs.begin(), runs.end(),
                       [&](const Run& run) { return run.results.has(column); });
  };
  if (all_have("over")) return mergeSweeps(runs);
  if (all_have("rank_of_right")) return mergeRelocations(runs);
  if (all_have("travelled_m") && all_have("kidnapped")) return mergeDrives(runs);
  throw std::runtime_error(runs.front().folder.string() +
                           ": these are not all runs of relocate, of sweep or of track");
}
}  // namespace

std::vector<fs::path> filesOfRuns(const std::vector<fs::path>& runs)
{
  std::vector<fs::path> files;
  for (const fs::path& folder : runs)
  {
    files.push_back(folder / "summary.json");
    files.push_back(folder / "results.csv");
  }
  return files;
}

MergedRuns mergeRuns(const std::vector<fs::path>& folders, const std::string& command)
{
  if (folders.size() < 2)
    throw std::invalid_argument("merge needs the folders of two runs or more");
  std::vector<Run> runs;
  runs.reserve(folders.size());
  for (const fs::path& folder : folders) runs.push_back(readRun(folder));
  checkAlike(runs);
  MergedRuns merged;
  merged.report = pool(runs);
  for (const Run& run : runs)
  {
    merged.complete = merged.complete && run.summary.complete;
    merged.report.provenance.data_files.push_back(run.folder / "results.csv");
  }
  merged.report.summary["complete"] = merged.complete;
  merged.report.provenance.command = command;
  merged.report.provenance.seed.reset();  // each run has its own
  addRuns(runs, merged.report);
  return merged;
}
}  // namespace sigloc
