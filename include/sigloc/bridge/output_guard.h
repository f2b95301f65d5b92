// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sigloc
{
// What a program asks before it writes, so that nothing is lost but what an earlier run of it left.

/// Throws std::runtime_error ("output: reason") when writing `output`, a file or a folder that is
/// replaced with all it holds, would destroy one of `inputs`: the same file, whatever path or link
/// leads to it, or one below. Inputs that are empty or do not exist are passed over.
void refuseToReplaceInputs(const std::filesystem::path& output,
                           const std::vector<std::filesystem::path>& inputs);

/// How a program knows what it may replace in an output folder that it shares with other files.
struct OutputFolderRule
{
  /// Whether a run may write an entry of this name.
  std::function<bool(const std::string& name)> writes;
  /// Whether an earlier run wrote such entries of the folder.
  std::function<bool(const std::filesystem::path& folder)> is_own;
  std::string owner;  ///< whose runs, for the message
};

/// Throws std::runtime_error ("folder: reason") when a run that writes into `folder` could replace
/// one of `inputs`, or an entry that no earlier run wrote. A folder that is not there is fine.
void checkOutputFolder(const std::filesystem::path& folder, const OutputFolderRule& rule,
                       const std::vector<std::filesystem::path>& inputs);
}  // namespace sigloc
