// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "eval/reports/evaluation_page.h"
#include "eval/reports/plot.h"
#include "eval/scoring/provenance.h"

namespace sigloc
{
/// Rows of cells as a Markdown table, columns aligned; the first row is the head.
std::string markdownTable(const std::vector<std::vector<std::string>>& rows);

/// What every sub-command leaves behind.
struct RunReport
{
  nlohmann::ordered_json summary;  ///< summary.json, all but the provenance
  std::string results;  ///< results.csv
  std::vector<std::pair<std::string, std::string>> tables;  ///< further files: name, content
  std::string text;  ///< report.md: title and tables
  std::vector<std::pair<std::string, Plot>> plots;  ///< name of the PNG file, figure
  std::string notes;  ///< report.md below the plots: what the columns mean, may be empty
  PageMap page;  ///< what report.html shows besides text and plots
  Provenance provenance;
};

/// Throws std::runtime_error ("path: reason") unless a report can be written into a folder. It must
/// replace none of `inputs`, and no file that no earlier run wrote. Such files have the name of one
/// of a report's files, or are PNG, in a folder without a summary.json. Other files may be there.
/// To be asked before hours of work.
void checkReportFolder(const std::filesystem::path& folder,
                       const std::vector<std::filesystem::path>& inputs);

/// Writes summary.json, results.csv, further tables, the plots that gnuplot can draw, report.md and
/// report.html into a folder. Makes the folder if need be. Writes all of it, or nothing where it
/// throws std::runtime_error ("path: reason").
void writeRunReport(const RunReport& report, const std::filesystem::path& folder);
}  // namespace sigloc
