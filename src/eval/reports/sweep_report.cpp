// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "eval/reports/sweep_report.h"
#include "eval/scoring/relocation_summary.h"

namespace sigloc
{
namespace
{
constexpr const char* kSweepNotes = R"(
A row pools all worlds. The truth is exact here: **wrong** is every confident answer that is not
right, and nothing is inaccurate. The errors of mapping scans' poses are independent of each other.
)";

struct SummarizedRow : RelocationSummary
{
  double value = 0;
};

/// The rows' summaries, their times compared with those of the first method at the same value.
std::vector<SummarizedRow> summarizeRows(const SweepReport& report)
{
  std::vector<SummarizedRow> rows;
  for (const SweepRow& row : report.rows)
  {
    rows.push_back({{row.method, {}}, row.value});
    for (const SweepRecord& record : row.records) rows.back().add(record.answer);
    const auto first =
        std::find_if(rows.begin(), rows.end(),
                     [&](const SummarizedRow& other) { return other.value == row.value; });
    rows.back().reference_ms = medianTime(*first);
  }
  return rows;
}

/// What is known of a method at a value; the label heads the values.
Columns<SummarizedRow> rowColumns(const std::string& label)
{
  using C = Column<SummarizedRow>;
  Columns<SummarizedRow> columns = {
      C("value", &SummarizedRow::value),
      C("", [](const SummarizedRow& row) { return sweptValueText(row.value); }, "", 0, {label})};
  for (const auto& column : summaryColumns()) columns.emplace_back(column);
  return columns;
}

std::string resultsCsv(const SweepReport& report)
{
  std::string csv = "over,value,world,method," + csvHead(relocationColumns()) + "\n";
  for (const SweepRow& row : report.rows)
  {
    for (const SweepRecord& record : row.records)
    {
      csv += fmt::format("{},{},{},{},{}\n", report.over, sweptValueText(row.value), record.world,
                         row.method, csvRow(relocationColumns(), record.answer));
    }
  }
  return csv;
}

using Share = Proportion (*)(const RelocationSummary&);

Proportion recall(const RelocationSummary& summary)
{
  return share(&Outcome::right)(summary);
}

/// Of no cases where the method has no verdict.
Proportion claimed(const RelocationSummary& summary, bool Outcome::*is, std::size_t cases)
{
  return {total(is)(summary), total(&Outcome::claims_verdict)(summary) > 0 ? cases : 0};
}

std::string kindOf(const std::string& world)
{
  return world.substr(0, world.find('-'));
}

/// recall@1 by kind of world: a line a kind and value, a column a method.
std::string kindTable(const SweepReport& report)
{
  std::vector<std::string> head = {"world", report.label};
  for (const std::string& method : methodsOf(report.rows)) head.push_back(method);
  std::map<std::pair<std::string, double>, std::vector<std::string>> lines;
  for (const SweepRow& row : report.rows)
  {
    std::map<std::string, RelocationSummary> by_kind;
    for (const SweepRecord& record : row.records) by_kind[kindOf(record.world)].add(record.answer);
    for (const auto& [kind, summary] : by_kind)
      lines[{kind, row.value}].push_back(withInterval(recall(summary)));
  }
  std::vector<std::vector<std::string>> rows = {head};
  for (const auto& [key, cells] : lines)
  {
    rows.push_back({key.first, sweptValueText(key.second)});
    rows.back().insert(rows.back().end(), cells.begin(), cells.end());
  }
  return markdownTable(rows);
}

/// A curve a method over the swept quantity; `add(row, series)` adds the point of one value.
template <class Add>
Plot plotOf(const SweepReport& report, const std::vector<SummarizedRow>& rows, Plot plot, Add&& add)
{
  plot.x_label = report.label;
  for (const std::string& method : methodsOf(report.rows))
  {
    PlotSeries& series = plot.series.emplace_back(PlotSeries{method, {}, true, {}});
    for (const SummarizedRow& row : rows)
      if (row.method == method) add(row, series);
  }
  return plot;
}

/// A share with its Wilson intervals; methods without cases are left out.
Plot sharePlot(const SweepReport& report, const std::vector<SummarizedRow>& rows,
               const std::string& title, Share share)
{
  const auto add = [&](const SummarizedRow& row, PlotSeries& series)
  {
    const Proportion p = share(row);
    if (p.cases == 0) return;
    series.points.emplace_back(row.value, p.value());
    series.intervals.emplace_back(p.low(), p.high());
  };
  return plotOf(report, rows, {title, "", "share of queries", false, false, {}}, add);
}

Plot timeRatioPlot(const SweepReport& report, const std::vector<SummarizedRow>& rows)
{
  const std::string title = "Median time over that of " + methodsOf(report.rows).front();
  const auto add = [](const SummarizedRow& row, PlotSeries& series)
  { series.points.emplace_back(row.value, medianTime(row) / row.reference_ms); };
  return plotOf(report, rows, {title, "", "ratio", false, true, {}}, add);
}
}  // namespace

std::string sweptValueText(double value)
{
  return detail::formatValue(value);
}

std::string sweepTable(const SweepReport& report)
{
  return markdownTable(table(rowColumns(report.label), summarizeRows(report)));
}

RunReport sweepRunReport(const SweepReport& report)
{
  const std::vector<SummarizedRow> rows = summarizeRows(report);
  RunReport files;
  const bool ran = report.map.maps > 0;  // else runs were merged
  files.summary["over"] = report.over;
  files.summary["label"] = report.label;
  files.summary["methods"] = methodsJson(rows, rowColumns(report.label),
                                         ran ? std::optional(report.peak_rss_mb) : std::nullopt);
  if (ran) files.summary["map"] = toJson(mapColumns(), report.map);
  files.results = resultsCsv(report);
  files.text = "# Sweep: " + report.over + "\n\n" + sweepTable(report) +
               "\n## First answer right, by kind of world\n\n" + kindTable(report);
  files.plots = {{"recall.png", sharePlot(report, rows, "First answer right", recall)},
                 {"confident_right.png",
                  sharePlot(report, rows, "Confident and right",
                            [](const RelocationSummary& s)
                            { return claimed(s, &Outcome::confident_right, recall(s).cases); })},
                 {"confidently_wrong.png",
                  sharePlot(report, rows, "Confidently wrong",
                            [](const RelocationSummary& s)
                            { return claimed(s, &Outcome::confidently_wrong, s.records.size()); })},
                 {"time_ratio.png", timeRatioPlot(report, rows)}};
  files.notes = relocationDefinitions() + kSweepNotes;
  if (ran) files.notes += mapSection(report.map);
  files.provenance = report.provenance;
  return files;
}

void writeSweepReport(const SweepReport& report, const std::filesystem::path& folder)
{
  writeRunReport(sweepRunReport(report), folder);
}
}  // namespace sigloc
