// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

#include "common_options.h"

namespace sigloc
{
/// A sub-command: declares its options on `command` and returns what runs it and gives the exit
/// code (0, or 2 for outputs that cover incomplete input).
using CommandSetup = std::function<int()> (*)(CLI::App& command, const std::string& command_line);

std::function<int()> setUpRelocate(CLI::App& command, const std::string& command_line);
std::function<int()> setUpMerge(CLI::App& command, const std::string& command_line);
std::function<int()> setUpReference(CLI::App& command, const std::string& command_line);
std::function<int()> setUpReliability(CLI::App& command, const std::string& command_line);
std::function<int()> setUpScale(CLI::App& command, const std::string& command_line);
std::function<int()> setUpLandmarks(CLI::App& command, const std::string& command_line);
std::function<int()> setUpSweep(CLI::App& command, const std::string& command_line);
std::function<int()> setUpTrack(CLI::App& command, const std::string& command_line);
}  // namespace sigloc
