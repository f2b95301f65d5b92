// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/reports/merge.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

#include "eval/data/csv_table.h"
#include "eval/reports/relocation_rows.h"
#include "eval/reports/sweep_report.h"
#include "eval/scoring/stored_relocations.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using detail::CsvTable;
using nlohmann::ordered_json;

/// What one run left in its folder.
struct Run
{
  fs::path folder;
  ordered_json summary;
  CsvTable results;

  std::vector<std::string> methods() const
  {
    std::vector<std::string> names;
    for (const auto& [name, method] : summary.at("methods").items()) names.push_back(name);
    return names;
  }
};

/// A file that was cut off at the end of a line looks whole.
void checkComplete(const Run& run)
{
  // A row is a query, or a step of a drive; elsewhere it sums many up.
  if (!run.results.has("query") && !run.results.has("step")) return;
  std::map<std::string, std::size_t> rows;
  for (std::size_t i = 0; i < run.results.rows(); ++i) ++rows[run.results.text(i, "method")];
  for (const auto& [name, method] : run.summary.at("methods").items())
  {
    const std::string counted = method.contains("steps") ? "steps" : "queries";
    const auto expected = method.find(counted);
    if (expected == method.end() || !expected->is_number_unsigned()) continue;
    if (rows[name] == expected->get<std::size_t>()) continue;
    throw std::runtime_error((run.folder / "results.csv").string() + ": holds " +
                             std::to_string(rows[name]) + " rows of " + name + ", not the " +
                             std::to_string(expected->get<std::size_t>()) + " " + counted +
                             " that summary.json counts");
  }
}

Run readRun(const fs::path& folder)
{
  const fs::path path = folder / "summary.json";
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": cannot be opened");
  ordered_json summary = ordered_json::parse(file, nullptr, false);
  if (summary.is_discarded() || !summary.contains("methods") || !summary.contains("provenance"))
  {
    throw std::runtime_error(path.string() + ": is no summary of sigloc-eval");
  }
  Run run{folder, std::move(summary), CsvTable(folder / "results.csv")};
  checkComplete(run);
  return run;
}

/// What a run asked: the checksums of its data or, in simulation, its seed, and the columns that
/// tell a question. Another seed asks a log nothing new.
std::set<std::string> questionsOf(const Run& run)
{
  const ordered_json& provenance = run.summary.at("provenance");
  std::string asked;
  // The world of a sweep has the seed in its name, and keeps it when merged.
  if (!run.results.has("world"))
  {
    const auto data = provenance.value("data", ordered_json::array());
    for (const auto& file : data) asked += " " + file.value("md5", "");
    if (data.empty()) asked = provenance.value("seed", ordered_json()).dump();
  }
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
    const std::string command = run.summary.at("provenance").value("command", "");
    rows.push_back({run.folder.string(), command});
    report.summary["runs"].push_back({{"folder", run.folder.string()}, {"command", command}});
  }
  report.text += "\n## The runs\n\n" + markdownTable(rows);
}

// relocate

using RecordsOfMethod = std::map<std::string, std::vector<RelocationRecord>>;

RecordsOfMethod recordsOf(const Run& run)
{
  RecordsOfMethod records;
  for (std::size_t i = 0; i < run.results.rows(); ++i)
  {
    records[run.results.text(i, "method")].push_back(detail::storedRelocation(run.results, i));
  }
  return records;
}

RunReport mergeRelocations(const std::vector<Run>& runs)
{
  RunReport report;
  report.results = "run," + relocationCsvHead() + "\n";
  RecordsOfMethod pooled;
  std::vector<std::vector<std::string>> by_run = {relocationTableHead()};
  by_run.front().insert(by_run.front().begin(), "run");
  const std::vector<std::string> methods = runs.front().methods();
  for (const Run& run : runs)
  {
    RecordsOfMethod records = recordsOf(run);
    const RelocationSummary reference = summarize(records[methods.front()], {});
    for (const std::string& method : methods)
    {
      by_run.push_back(relocationTableRow(method, summarize(records[method], {}), reference));
      by_run.back().insert(by_run.back().begin(), run.folder.string());
      for (const RelocationRecord& record : records[method])
      {
        report.results +=
            detail::csvCell(run.folder.string()) + "," + relocationCsvRow(method, record) + "\n";
        pooled[method].push_back(record);
      }
    }
  }
  std::vector<std::vector<std::string>> table = {relocationTableHead()};
  const RelocationSummary reference = summarize(pooled[methods.front()], {});
  for (const std::string& method : methods)
  {
    const RelocationSummary summary = summarize(pooled[method], {});
    report.summary["methods"][method] = toJson(summary);
    table.push_back(relocationTableRow(method, summary, reference));
  }
  report.text = "# Relocation from one look, " + std::to_string(runs.size()) + " runs\n\n" +
                markdownTable(table) + "\n## Run by run\n\n" + markdownTable(by_run);
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
        .records.push_back({world, detail::storedRelocation(run.results, i)});
  }
}

RunReport mergeSweeps(const std::vector<Run>& runs)
{
  SweepReport report;
  report.over = runs.front().results.text(0, "over");
  report.label = runs.front().summary.value("label", report.over);
  for (const Run& run : runs) addSweepRun(run, report);
  std::stable_sort(report.rows.begin(), report.rows.end(),
                   [](const SweepRow& a, const SweepRow& b) { return a.value < b.value; });
  return sweepRunReport(report);
}

// track

/// Sums counts and re-computes shares; all else of a method's summary cannot be summed.
ordered_json summedCounts(const std::vector<Run>& runs, const std::string& method)
{
  ordered_json sum = ordered_json::object();
  std::map<std::string, Proportion> shares;
  for (const Run& run : runs)
  {
    for (const auto& [key, value] : run.summary.at("methods").at(method).items())
    {
      constexpr std::string_view kSuffix = "_counts";
      const bool is_share = key.size() > kSuffix.size() && value.is_array() && value.size() == 2 &&
                            key.compare(key.size() - kSuffix.size(), kSuffix.size(), kSuffix) == 0;
      if (value.is_number_unsigned())
      {
        sum[key] = sum.value(key, std::uint64_t{0}) + value.get<std::uint64_t>();
      }
      else if (is_share)
      {
        const std::string name = key.substr(0, key.size() - kSuffix.size());
        shares[name].count += value.at(0).get<std::size_t>();
        shares[name].cases += value.at(1).get<std::size_t>();
      }
    }
  }
  for (const auto& [name, share] : shares) addProportion(sum, name, share);
  return sum;
}

std::vector<std::vector<std::string>> countsTable(const ordered_json& methods)
{
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, method] : methods.items())
  {
    std::vector<std::string> head = {"method"};
    std::vector<std::string> cells = {name};
    for (const auto& [key, value] : method.items())
    {
      const bool is_share = method.contains(key + "_counts");
      if (!value.is_number_unsigned() && !is_share) continue;
      head.push_back(key);
      if (is_share)
      {
        const auto& counts = method.at(key + "_counts");
        cells.push_back(withInterval({counts.at(0), counts.at(1)}));
      }
      else
      {
        cells.push_back(std::to_string(value.get<std::uint64_t>()));
      }
    }
    if (rows.empty()) rows.push_back(head);
    rows.push_back(cells);
  }
  return rows;
}

RunReport mergeDrives(const std::vector<Run>& runs)
{
  RunReport report;
  for (const std::string& method : runs.front().methods())
  {
    report.summary["methods"][method] = summedCounts(runs, method);
  }
  report.results = "run,method,confidently_wrong,queries\n";
  for (const Run& run : runs)
  {
    for (const auto& [name, method] : run.summary.at("methods").items())
    {
      report.results += detail::csvCell(run.folder.string()) + "," + name + "," +
                        std::to_string(method.value("confidently_wrong", 0)) + "," +
                        std::to_string(method.value("queries", 0)) + "\n";
    }
  }
  report.text = "# Wake-ups, " + std::to_string(runs.size()) + " runs\n\n" +
                markdownTable(countsTable(report.summary["methods"]));
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
    merged.complete = merged.complete && run.summary.value("complete", true);
    merged.report.provenance.data_files.push_back(run.folder / "results.csv");
  }
  merged.report.summary["complete"] = merged.complete;
  merged.report.provenance.command = command;
  merged.report.provenance.seed.reset();  // each run has its own
  addRuns(runs, merged.report);
  return merged;
}
}  // namespace sigloc
