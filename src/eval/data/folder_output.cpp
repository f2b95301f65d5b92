// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/data/folder_output.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "sigloc/io/file_output.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
constexpr const char* kPart = ".part-";
constexpr const char* kLock = ".sigloc-in-progress";

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

/// A file that is locked as long as the object exists. The lock shows other runs that this one goes
/// on.
class Lock
{
 public:
  explicit Lock(const fs::path& path, int more_flags = 0)
      : file_(open(path.c_str(), O_RDWR | O_CLOEXEC | more_flags, 0600)),
        held_(file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) == 0)
  {
  }
  ~Lock()
  {
    if (file_ >= 0) close(file_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  bool held() const { return held_; }

 private:
  int file_;
  bool held_;
};

/// Removes the parts within a folder whose runs were killed. A folder without a lock file is no
/// part.
void removeAbandonedParts(const fs::path& folder)
{
  std::error_code ignored;
  std::vector<fs::path> parts;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
  {
    if (entry.path().filename().string().rfind(kPart, 0) == 0) parts.push_back(entry.path());
  }
  for (const fs::path& part : parts)
  {
    const Lock lock(part / kLock);
    if (lock.held()) fs::remove_all(part, ignored);
  }
}

/// A folder, made if need be, and a new one within it for files that are not yet complete. The
/// destructor removes what was made, unless keep() was called.
class FolderInProgress
{
 public:
  explicit FolderInProgress(const fs::path& folder) : folder_(folder), made_(missingFolders(folder))
  {
    removeAbandonedParts(folder);
    if (const std::error_code error = makePart())
    {
      removeWhatWasMade();
      fail(folder, error.message());
    }
  }
  ~FolderInProgress()
  {
    std::error_code ignored;
    fs::remove_all(part_, ignored);
    removeWhatWasMade();
  }
  FolderInProgress(const FolderInProgress&) = delete;
  FolderInProgress& operator=(const FolderInProgress&) = delete;

  /// Where the files belong until keep(), locked.
  const fs::path& part() const { return part_; }

  /// Moves the complete files to their place, and waits until the disk has it so.
  void keep() const
  {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(part_, error))
    {
      if (entry.path().filename() == kLock) continue;
      if (!error) fs::rename(entry.path(), folder_ / entry.path().filename(), error);
    }
    if (error) fail(folder_, error.message());
    syncFolder(folder_);
  }

 private:
  std::error_code makePart()
  {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) return error;
    // A name of its own: neither the user's, nor that of another run.
    std::string part = (folder_ / (std::string(kPart) + "XXXXXX")).string();
    if (mkdtemp(part.data()) == nullptr) return {errno, std::generic_category()};
    part_ = part;
    return {};
  }

  void removeWhatWasMade() const
  {
    // A folder that holds something is kept.
    std::error_code ignored;
    for (const fs::path& folder : made_) fs::remove(folder, ignored);
  }

  fs::path folder_;
  fs::path part_;
  std::vector<fs::path> made_;  // deepest first
};

/// Turns a message about a file in `part` into one about the same file in `folder`.
std::string atPlace(std::string message, const fs::path& part, const fs::path& folder)
{
  const std::size_t at = message.find(part.string());
  return at == std::string::npos ? message
                                 : message.replace(at, part.string().size(), folder.string());
}
}  // namespace

void fillFolder(const fs::path& folder, const std::function<void(const fs::path& part)>& fill)
{
  const FolderInProgress files(folder);
  // It gets its name after it is locked, so that no other run finds it without a lock.
  const fs::path unnamed = files.part() / (std::string(kLock) + "-new");
  const Lock lock(unnamed, O_CREAT | O_EXCL);
  std::error_code ignored;
  if (lock.held()) fs::rename(unnamed, files.part() / kLock, ignored);
  try
  {
    fill(files.part());
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(atPlace(error.what(), files.part(), folder));
  }
  files.keep();
}
}  // namespace sigloc
