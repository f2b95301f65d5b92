// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sigloc/eval/relocation_scoring.h"

namespace sigloc
{
/// A number in fixed notation; an empty string for NaN, so that a table cell stays empty.
std::string fixedNumber(double value, int decimals);

/// "0.968 (0.94-0.98)", or "-" without cases.
std::string withInterval(const Proportion& proportion);

/// {"median", "p95", "mean"}.
nlohmann::ordered_json toJson(const Quantiles& quantiles);

/// Adds `name` and `name_interval` ([low, high], 95 %) to an object; null without cases.
void addProportion(nlohmann::ordered_json& object, const std::string& name,
                   const Proportion& proportion);

/// Rows of cells as a Markdown table, columns aligned; the first row is the head.
std::string markdownTable(const std::vector<std::vector<std::string>>& rows);

/// The provenance as a Markdown list.
std::string provenanceSection(const nlohmann::ordered_json& provenance);

/// Writes a text file. Throws std::runtime_error ("path: reason").
void writeTextFile(const std::filesystem::path& path, const std::string& text);

/// Makes a folder, parents included. Throws std::runtime_error ("path: reason").
void makeFolder(const std::filesystem::path& folder);
}  // namespace sigloc
