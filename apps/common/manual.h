// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace sigloc
{
/// A program's man page (roff, section 1), of what its --help tells. `source` stands at the foot:
/// "sigloc 0.1.0".
std::string manPage(const CLI::App& app, const std::string& source);

/// How the program is called, or the command of it that was given: "sigloc-map info [OPTIONS]
/// file".
std::string usage(const CLI::App& app);

/// Writes --help as CLI11 does, but its line of usage as `usage` does: with the required options.
class HelpFormatter : public CLI::Formatter
{
 public:
  std::string make_usage(const CLI::App* app, std::string name) const override;
};

/// A program's completion for bash: its commands, and the options of the one that was typed.
std::string bashCompletion(const CLI::App& app);
}  // namespace sigloc
