// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "eval/scoring/relocation_scoring.h"

namespace sigloc
{
// How judged relocations are written down, whatever run they come from.

/// A summary as an object of summary.json, without what belongs to one process (memory, look-ups).
nlohmann::ordered_json toJson(const RelocationSummary& summary);

/// Column names of results.csv, comma-separated; the last column is the time.
std::string relocationCsvHead();

/// One line of results.csv, without its end.
std::string relocationCsvRow(const std::string& method, const RelocationRecord& record);

/// Head of the Markdown table.
std::vector<std::string> relocationTableHead();

/// One row of it; the ratio is that of the median times to those of `reference`.
std::vector<std::string> relocationTableRow(const std::string& method,
                                            const RelocationSummary& summary,
                                            const RelocationSummary& reference);

/// What the columns mean, as a section of Markdown.
std::string relocationDefinitions();
}  // namespace sigloc
