// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <map>

#include "eval/reports/relocation_rows.h"
#include "eval/reports/report_files.h"
#include "eval/reports/sweep_report.h"

namespace sigloc
{
namespace
{
constexpr const char* kNotes = R"(
A row pools all worlds. The truth is exact here: **wrong** is every confident answer that is not
right, and nothing is inaccurate. The errors of mapping scans' poses are independent of each other.
)";

RelocationSummary summaryOf(const std::vector<SweepRecord>& records)
{
  std::vector<RelocationRecord> answers;
  answers.reserve(records.size());
  for (const SweepRecord& record : records) answers.push_back(record.answer);
  return summarize(answers, simulationGates());
}

struct SummarizedRow
{
  double value;
  std::string method;
  RelocationSummary summary;
};

std::vector<SummarizedRow> summarizeRows(const SweepReport& report)
{
  std::vector<SummarizedRow> rows;
  for (const SweepRow& row : report.rows)
  {
    rows.push_back({row.value, row.method, summaryOf(row.records)});
  }
  return rows;
}

/// The first method's summary at the same value: what ratios of times refer to.
const RelocationSummary& referenceOf(const std::vector<SummarizedRow>& rows, double value)
{
  return std::find_if(rows.begin(), rows.end(),
                      [&](const SummarizedRow& row) { return row.value == value; })
      ->summary;
}

std::vector<std::string> methodsOf(const SweepReport& report)
{
  std::vector<std::string> methods;
  for (const SweepRow& row : report.rows)
  {
    if (row.value == report.rows.front().value) methods.push_back(row.method);
  }
  return methods;
}

nlohmann::ordered_json summaryJson(const SweepReport& report,
                                   const std::vector<SummarizedRow>& rows)
{
  nlohmann::ordered_json json;
  json["over"] = report.over;
  json["label"] = report.label;
  for (const std::string& method : methodsOf(report))
  {
    std::vector<SweepRecord> all;
    nlohmann::ordered_json entries = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      if (rows[i].method != method) continue;
      nlohmann::ordered_json entry = {{"value", rows[i].value}};
      entry.update(toJson(rows[i].summary));
      entries.push_back(entry);
      all.insert(all.end(), report.rows[i].records.begin(), report.rows[i].records.end());
    }
    json["methods"][method] = toJson(summaryOf(all));
    if (report.map.maps > 0) json["methods"][method]["peak_rss_mb"] = report.peak_rss_mb;
    json["methods"][method]["rows"] = entries;
  }
  if (report.map.maps > 0) json["map"] = toJson(report.map);
  return json;
}

std::string resultsCsv(const SweepReport& report)
{
  std::string csv = "over,value,world," + relocationCsvHead() + "\n";
  for (const SweepRow& row : report.rows)
  {
    for (const SweepRecord& record : row.records)
    {
      csv += report.over + "," + sweptValueText(row.value) + "," + record.world + "," +
             relocationCsvRow(row.method, record.answer) + "\n";
    }
  }
  return csv;
}

std::string kindOf(const std::string& world)
{
  return world.substr(0, world.find('-'));
}

/// recall@1 by kind of world: a line a kind and value, a column a method.
std::string kindTable(const SweepReport& report)
{
  std::vector<std::string> head = {"world", report.label};
  for (const std::string& method : methodsOf(report)) head.push_back(method);
  std::map<std::pair<std::string, double>, std::vector<std::string>> lines;
  for (const SweepRow& row : report.rows)
  {
    std::map<std::string, std::vector<SweepRecord>> by_kind;
    for (const SweepRecord& record : row.records) by_kind[kindOf(record.world)].push_back(record);
    for (const auto& [kind, records] : by_kind)
    {
      lines[{kind, row.value}].push_back(withInterval(summaryOf(records).recall_at_1));
    }
  }
  std::vector<std::vector<std::string>> rows = {head};
  for (const auto& [key, cells] : lines)
  {
    rows.push_back({key.first, sweptValueText(key.second)});
    rows.back().insert(rows.back().end(), cells.begin(), cells.end());
  }
  return markdownTable(rows);
}

using Share = Proportion (*)(const RelocationSummary&);

Proportion recall(const RelocationSummary& s)
{
  return s.recall_at_1;
}

Proportion confidentAndRight(const RelocationSummary& s)
{
  return {s.confident_right, s.claims_verdict ? s.recall_at_1.cases : 0};
}

Proportion confidentlyWrong(const RelocationSummary& s)
{
  return {s.confidently_wrong, s.claims_verdict ? s.queries : 0};
}

/// A share with its Wilson intervals over the swept quantity; methods without cases are left out.
Plot sharePlot(const SweepReport& report, const std::vector<SummarizedRow>& rows,
               const std::string& title, Share share)
{
  Plot plot{title, report.label, "share of queries", false, false, {}};
  for (const std::string& method : methodsOf(report))
  {
    PlotSeries series{method, {}, true, {}};
    for (const SummarizedRow& row : rows)
    {
      const Proportion p = share(row.summary);
      if (row.method != method || p.cases == 0) continue;
      series.points.emplace_back(row.value, p.value());
      series.intervals.emplace_back(p.low(), p.high());
    }
    plot.series.push_back(series);
  }
  return plot;
}

Plot timeRatioPlot(const SweepReport& report, const std::vector<SummarizedRow>& rows)
{
  const std::vector<std::string> methods = methodsOf(report);
  Plot plot{"Median time over that of " + methods.front(), report.label, "ratio", false, true, {}};
  for (const std::string& method : methods)
  {
    PlotSeries series{method, {}, true, {}};
    for (const SummarizedRow& row : rows)
    {
      if (row.method != method) continue;
      const double reference = referenceOf(rows, row.value).time_ms.median;
      series.points.emplace_back(row.value, row.summary.time_ms.median / reference);
    }
    plot.series.push_back(series);
  }
  return plot;
}
}  // namespace

std::string sweptValueText(double value)
{
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string sweepTable(const SweepReport& report)
{
  const std::vector<SummarizedRow> summarized = summarizeRows(report);
  std::vector<std::vector<std::string>> rows = {relocationTableHead()};
  rows.front().insert(rows.front().begin(), report.label);
  for (const SummarizedRow& row : summarized)
  {
    rows.push_back(relocationTableRow(row.method, row.summary, referenceOf(summarized, row.value)));
    rows.back().insert(rows.back().begin(), sweptValueText(row.value));
  }
  return markdownTable(rows);
}

RunReport sweepRunReport(const SweepReport& report)
{
  const std::vector<SummarizedRow> rows = summarizeRows(report);
  RunReport files;
  files.summary = summaryJson(report, rows);
  files.results = resultsCsv(report);
  files.text = "# Sweep: " + report.over + "\n\n" + sweepTable(report) +
               "\n## First answer right, by kind of world\n\n" + kindTable(report);
  files.plots = {
      {"recall.png", sharePlot(report, rows, "First answer right", recall)},
      {"confident_right.png", sharePlot(report, rows, "Confident and right", confidentAndRight)},
      {"confidently_wrong.png", sharePlot(report, rows, "Confidently wrong", confidentlyWrong)},
      {"time_ratio.png", timeRatioPlot(report, rows)}};
  files.notes = relocationDefinitions() + kNotes;
  if (report.map.maps > 0) files.notes += mapSection(report.map);
  files.provenance = report.provenance;
  return files;
}

void writeSweepReport(const SweepReport& report, const std::filesystem::path& folder)
{
  writeRunReport(sweepRunReport(report), folder);
}
}  // namespace sigloc
