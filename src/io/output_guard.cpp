// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/io/file_output.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;

/// Whether a file is `whole`, perhaps by a link, or is inside it. Both must exist.
bool isPartOf(const fs::path& file, const fs::path& whole)
{
  std::error_code error;
  if (fs::equivalent(file, whole, error)) return true;
  const fs::path inner = fs::canonical(file, error);
  const fs::path outer = fs::canonical(whole, error);
  return !error &&
         std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}
}  // namespace

void refuseToReplaceInputs(const fs::path& output, const std::vector<fs::path>& inputs)
{
  std::error_code unnameable;
  if (!fs::exists(output, unnameable)) return;
  for (const fs::path& input : inputs)
  {
    if (input.empty() || !fs::exists(input, unnameable) || !isPartOf(input, output)) continue;
    throw std::runtime_error(output.string() + ": " +
                             (fs::is_directory(output) ? "holds the input " : "is the input ") +
                             input.string() + "; not overwritten");
  }
}

void checkOutputFolder(const fs::path& folder, const OutputFolderRule& rule,
                       const std::vector<fs::path>& inputs)
{
  std::error_code error;
  const bool is_own = rule.is_own(folder);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
  {
    const std::string name = entry.path().filename().string();
    if (!rule.writes(name)) continue;
    refuseToReplaceInputs(entry.path(), inputs);
    if (is_own) continue;
    throw std::runtime_error(folder.string() + ": holds " + name +
                             ", but is no folder of an earlier run of " + rule.owner +
                             "; not overwritten");
  }
}
}  // namespace sigloc
