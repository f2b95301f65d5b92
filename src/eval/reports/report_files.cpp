// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/reports/report_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>

#include "eval/data/folder_output.h"
#include "sigloc/io/file_output.h"

namespace sigloc
{
namespace
{
constexpr const char* kReportTool = "sigloc-eval";

/// The provenance as a Markdown list.
std::string provenanceSection(const nlohmann::ordered_json& provenance)
{
  std::string text;
  for (const auto& [key, value] : provenance.items())
  {
    if (key == "data") continue;
    text += fmt::format("* {}: `{}`\n", key,
                        value.is_string() ? value.get<std::string>() : value.dump());
  }
  for (const auto& file : provenance.at("data"))
  {
    text += fmt::format("* data: `{}`, MD5 `{}`\n", file.at("file").get<std::string>(),
                        file.at("md5").get<std::string>());
  }
  return text;
}

/// Writes all files of a report into a folder that exists.
void writeFiles(const RunReport& report, const std::filesystem::path& folder)
{
  nlohmann::ordered_json summary = report.summary;
  summary["provenance"] = toJson(report.provenance);
  writeFile(folder / "results.csv", report.results);
  for (const auto& [file, content] : report.tables) writeFile(folder / file, content);
  writeFile(folder / "summary.json", summary.dump(2) + "\n");
  const std::string ending =
      report.notes + "\n## Provenance\n\n" + provenanceSection(summary["provenance"]);
  writeFile(folder / "report.html",
            evaluationPage(report.provenance.command, report.text + "\n" + ending, report.plots,
                           report.page));
  std::string text = report.text;
  for (const auto& [file, plot] : report.plots)
  {
    if (drawPlot(plot, folder / file)) text += "\n![" + plot.title + "](" + file + ")\n";
  }
  writeFile(folder / "report.md", text + ending);
}

bool isReportFile(const std::string& name)
{
  static const std::set<std::string> kNames = {"summary.json", "results.csv", "candidates.csv",
                                               "runs.csv",     "report.md",   "report.html",
                                               "failures"};
  return kNames.count(name) > 0 || std::filesystem::path(name).extension() == ".png";
}

/// Whether sigloc-eval wrote the folder's summary.
bool isReportFolder(const std::filesystem::path& folder)
{
  if (!std::filesystem::is_regular_file(folder / "summary.json")) return false;
  std::ifstream file(folder / "summary.json");
  const auto summary = nlohmann::json::parse(file, nullptr, false);
  const nlohmann::json::json_pointer command("/provenance/command");
  if (!summary.is_object() || !summary.contains(command)) return false;
  const auto& line = summary.at(command);
  return line.is_string() && line.get<std::string>().rfind(kReportTool, 0) == 0;
}
}  // namespace

void checkReportFolder(const std::filesystem::path& folder,
                       const std::vector<std::filesystem::path>& inputs)
{
  checkWritableFolder(folder);
  checkOutputFolder(folder, {isReportFile, isReportFolder, kReportTool}, inputs);
}

std::string markdownTable(const std::vector<std::vector<std::string>>& rows)
{
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
  {
    widths.resize(std::max(widths.size(), row.size()), 3);
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string out;
  for (std::size_t r = 0; r < rows.size(); ++r)
  {
    for (std::size_t i = 0; i < widths.size(); ++i)
      out += fmt::format("| {:{}} ", i < rows[r].size() ? rows[r][i] : "", widths[i]);
    out += "|\n";
    if (r > 0) continue;
    for (const std::size_t width : widths) out += "|" + std::string(width + 2, '-');
    out += "|\n";
  }
  return out;
}

void writeRunReport(const RunReport& report, const std::filesystem::path& folder)
{
  fillFolder(folder, [&](const std::filesystem::path& part) { writeFiles(report, part); });
}
}  // namespace sigloc
