// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "command_line.h"

namespace sigloc::test
{
inline constexpr std::ptrdiff_t kLabSteps = 37;  // of kLabLog
inline constexpr const char* kNoPictures = "[sigloc.localize]\npictures = false\n";

/// Writes `run.ini` with the files of a run and what follows them.
inline void writeConfig(const TemporaryFolder& folder, const std::string& map,
                        const std::string& rawlog, const std::string& more = "")
{
  writeText(folder / "run.ini", "[LocalizationExperiment]\nmap_file = " + map +
                                    "\nrawlog_file = " + rawlog + "\n" + more);
}

/// Runs sigloc-localize by `run.ini`.
inline CommandResult localize(const TemporaryFolder& folder, const std::string& out = "out")
{
  return run(folder, "sigloc-localize", {"run.ini", "--out", out, "--quiet"});
}

/// The summary that a program has written into its output folder.
inline nlohmann::json summaryOf(const TemporaryFolder& folder, const std::string& out = "out")
{
  return nlohmann::json::parse(readBytes(folder / (out + "/summary.json")));
}
}  // namespace sigloc::test
