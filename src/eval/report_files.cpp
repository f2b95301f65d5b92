// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/eval/report_files.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace sigloc
{
namespace
{
/// The provenance as a Markdown list.
std::string provenanceSection(const nlohmann::ordered_json& provenance)
{
  std::ostringstream out;
  for (const auto& [key, value] : provenance.items())
  {
    if (key == "data") continue;
    out << "* " << key << ": `" << (value.is_string() ? value.get<std::string>() : value.dump())
        << "`\n";
  }
  for (const auto& file : provenance.at("data"))
  {
    out << "* data: `" << file.at("file").get<std::string>() << "`, MD5 `"
        << file.at("md5").get<std::string>() << "`\n";
  }
  return out.str();
}

void writeTextFile(const std::filesystem::path& path, const std::string& text)
{
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

/// Writes all files of a report into a folder that exists.
void writeFiles(const RunReport& report, const std::filesystem::path& folder)
{
  nlohmann::ordered_json summary = report.summary;
  summary["provenance"] = toJson(report.provenance);
  writeTextFile(folder / "results.csv", report.results);
  for (const auto& [file, content] : report.tables) writeTextFile(folder / file, content);
  writeTextFile(folder / "summary.json", summary.dump(2) + "\n");
  std::string text = report.text;
  for (const auto& [file, plot] : report.plots)
  {
    if (drawPlot(plot, folder / file)) text += "\n![" + plot.title + "](" + file + ")\n";
  }
  text += report.notes + "\n## Provenance\n\n" + provenanceSection(summary["provenance"]);
  writeTextFile(folder / "report.md", text);
}

/// A folder, made if need be, and one within it for files that are not yet complete. What was made
/// is gone with the object unless it was kept.
class FolderInProgress
{
 public:
  explicit FolderInProgress(const std::filesystem::path& folder)
      : folder_(folder), part_(folder / ".part")
  {
    for (auto parent = std::filesystem::absolute(folder).lexically_normal();
         !parent.empty() && !std::filesystem::exists(parent); parent = parent.parent_path())
    {
      made_.push_back(parent);
    }
    std::filesystem::create_directories(part_);
  }
  ~FolderInProgress()
  {
    std::error_code ignored;
    std::filesystem::remove_all(part_, ignored);
    // Deepest first; a folder that holds something stays.
    for (const auto& folder : made_) std::filesystem::remove(folder, ignored);
  }
  FolderInProgress(const FolderInProgress&) = delete;
  FolderInProgress& operator=(const FolderInProgress&) = delete;

  const std::filesystem::path& part() const { return part_; }

  /// Moves the complete files to their place.
  void keep() const
  {
    for (const auto& entry : std::filesystem::directory_iterator(part_))
    {
      std::filesystem::rename(entry.path(), folder_ / entry.path().filename());
    }
  }

 private:
  std::filesystem::path folder_;
  std::filesystem::path part_;
  std::vector<std::filesystem::path> made_;
};
}  // namespace

void checkWritableFolder(const std::filesystem::path& folder)
{
  if (folder.empty()) throw std::runtime_error("the name of the folder to write to is empty");
  auto existing = std::filesystem::absolute(folder).lexically_normal();
  std::error_code error;
  while (existing.has_relative_path() && !std::filesystem::exists(existing, error))
  {
    existing = existing.parent_path();
  }
  if (!std::filesystem::is_directory(existing, error))
  {
    throw std::runtime_error(folder.string() + ": " + existing.string() + " is no folder");
  }
  if (access(existing.c_str(), W_OK | X_OK) != 0)
  {
    throw std::runtime_error(folder.string() + ": no right to write into " + existing.string());
  }
}

std::string fixedNumber(double value, int decimals)
{
  if (std::isnan(value)) return "";
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

std::string withInterval(const Proportion& proportion)
{
  if (proportion.cases == 0) return "-";
  return fixedNumber(proportion.value(), 3) + " (" + fixedNumber(proportion.low(), 2) + "-" +
         fixedNumber(proportion.high(), 2) + ")";
}

nlohmann::ordered_json toJson(const Quantiles& quantiles)
{
  return {{"median", quantiles.median}, {"p95", quantiles.p95}, {"mean", quantiles.mean}};
}

void addProportion(nlohmann::ordered_json& object, const std::string& name,
                   const Proportion& proportion)
{
  object[name] = proportion.value();
  object[name + "_counts"] = {proportion.count, proportion.cases};
  object[name + "_interval"] = nullptr;
  if (proportion.cases > 0)
  {
    object[name + "_interval"] =
        nlohmann::ordered_json::array({proportion.low(), proportion.high()});
  }
}

std::string markdownTable(const std::vector<std::vector<std::string>>& rows)
{
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
  {
    widths.resize(std::max(widths.size(), row.size()), 3);
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::ostringstream out;
  for (std::size_t r = 0; r < rows.size(); ++r)
  {
    out << "|";
    for (std::size_t i = 0; i < widths.size(); ++i)
    {
      const std::string cell = i < rows[r].size() ? rows[r][i] : "";
      out << " " << cell << std::string(widths[i] - cell.size(), ' ') << " |";
    }
    out << "\n";
    if (r > 0) continue;
    out << "|";
    for (const std::size_t width : widths) out << std::string(width + 2, '-') << "|";
    out << "\n";
  }
  return out.str();
}

void writeRunReport(const RunReport& report, const std::filesystem::path& folder)
{
  try
  {
    const FolderInProgress files(folder);
    writeFiles(report, files.part());
    files.keep();
  }
  catch (const std::filesystem::filesystem_error& error)
  {
    throw std::runtime_error(folder.string() + ": " + error.code().message());
  }
}
}  // namespace sigloc
