// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Programs call some of this before they load the library. So nothing is called here that needs
// MRPT's libraries.
#include "sigloc/io/file_output.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ostream>
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

void checkWritableFolder(const fs::path& folder)
{
  if (folder.empty()) throw std::runtime_error("the name of the folder to write to is empty");
  std::error_code error;
  const fs::path whole = fs::absolute(folder, error).lexically_normal();
  if (error) throw std::runtime_error(folder.string() + ": " + error.message());
  fs::path existing = whole;
  while (existing.has_relative_path() && !fs::exists(existing, error))
  {
    existing = existing.parent_path();
  }
  if (!fs::is_directory(existing, error))
  {
    const std::string part = existing == whole ? "" : existing.string() + " ";
    throw std::runtime_error(folder.string() + ": " + part + "is no folder");
  }
  if (access(existing.c_str(), W_OK | X_OK) != 0)
  {
    throw std::runtime_error(folder.string() + ": no right to write into " + existing.string());
  }
}

void checkWritableFile(const fs::path& file)
{
  std::error_code error;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (fs::is_directory(file, error)) throw std::runtime_error(file.string() + ": is a folder");
  if (!fs::is_directory(folder, error))
    throw std::runtime_error(file.string() + ": there is no folder " + folder.string());
  checkWritableFolder(folder);
}

void checkOutputFolder(const fs::path& folder, const OutputFolderRule& rule,
                       const std::vector<fs::path>& inputs)
{
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw std::runtime_error(folder.string() + ": is no folder; not overwritten");
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

void finishOutput(std::ostream& out)
{
  // Where writing has failed already, the code of that error is still there, and flush() sets none.
  if (out) errno = 0;
  if (out.flush()) return;
  const std::string reason = std::generic_category().message(errno != 0 ? errno : EIO);
  throw std::runtime_error("standard output: cannot be written: " + reason);
}

std::string oneLine(const std::string& message)
{
  // MRPT's exceptions wrap the reason in a header, the source position and a call stack.
  std::string line = message;
  const std::string header = "==== MRPT exception ====";
  const std::size_t wrapped = message.find(header);
  if (wrapped != std::string::npos)
  {
    std::size_t begin = wrapped + header.size();
    const std::string marker = "Message:";
    const std::size_t found = message.find(marker, begin);
    if (found != std::string::npos) begin = found + marker.size();
    begin = std::min(message.find_first_not_of(" \n", begin), message.size());
    line = message.substr(begin, message.find('\n', begin) - begin);
  }
  line.erase(line.find_last_not_of('\n') + 1);
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
  std::replace_if(line.begin(), line.end(), is_control, '?');
  // The file is at the beginning, and the reason at the end.
  constexpr std::size_t kMost = 1000;
  constexpr std::size_t kFirst = 600;
  constexpr std::size_t kLast = 300;
  if (line.size() > kMost) line = line.substr(0, kFirst) + "..." + line.substr(line.size() - kLast);
  return line;
}
}  // namespace sigloc
