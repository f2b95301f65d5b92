// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/eval/FolderInProgress.h"

#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& folder, const std::string& reason)
{
  throw std::runtime_error(folder.string() + ": " + reason);
}

/// The folders on the way to `folder`, itself included, that are not there yet; deepest first.
std::vector<fs::path> missingFolders(const fs::path& folder)
{
  std::vector<fs::path> missing;
  std::error_code unnameable;
  for (auto parent = fs::absolute(folder).lexically_normal();
       !parent.empty() && !fs::exists(parent, unnameable); parent = parent.parent_path())
  {
    missing.push_back(parent);
  }
  return missing;
}
}  // namespace

FolderInProgress::FolderInProgress(const fs::path& folder)
    : folder_(folder), made_(missingFolders(folder))
{
  std::error_code error;
  fs::create_directories(folder, error);
  // A name of its own: neither the user's, nor what a run that was killed has left.
  std::string part = (folder / ".part-XXXXXX").string();
  if (!error && mkdtemp(part.data()) == nullptr) error = {errno, std::generic_category()};
  if (error)
  {
    removeWhatWasMade();
    fail(folder, error.message());
  }
  part_ = part;
}

FolderInProgress::~FolderInProgress()
{
  std::error_code ignored;
  fs::remove_all(part_, ignored);
  removeWhatWasMade();
}

void FolderInProgress::keep() const
{
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(part_, error))
  {
    if (!error) fs::rename(entry.path(), folder_ / entry.path().filename(), error);
  }
  if (error) fail(folder_, error.message());
}

void FolderInProgress::removeWhatWasMade() const
{
  // A folder that holds something stays.
  std::error_code ignored;
  for (const fs::path& folder : made_) fs::remove(folder, ignored);
}
}  // namespace sigloc
