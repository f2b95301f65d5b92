// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>  // renameat2
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "localize/pf_localization_files.h"
#include "localize/run_page.h"
#include "sigloc/io/file_output.h"

namespace sigloc::detail
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* kMark = "belief";  // a run makes this folder first

[[noreturn]] void refuse(const fs::path& folder, const std::string& reason)
{
  throw std::runtime_error(folder.string() + ": " + reason + "; not overwritten");
}

bool isRunFile(const std::string& name)
{
  static const std::set<std::string> kNames = []
  {
    std::set<std::string> names = {"path.tum",         "path_unsure.tum", "steps.csv",
                                   "annotated.rawlog", kRunSummaryFile,   kRunPageFile};
    names.insert(pfLocalizationFiles().begin(), pfLocalizationFiles().end());
    return names;
  }();
  return kNames.count(withoutTemporaryEnding(name)) > 0;
}

/// The first entry inside a folder's entry that no run writes, or nullopt.
std::optional<fs::path> foreignPartOf(const fs::directory_entry& entry)
{
  static const std::map<std::string, std::set<std::string>> kParts = {
      {"belief", {".CPosePDFSOG", ".txt"}},
      {"3D", {".3Dscene"}},
      {"pictures", {".png"}},
      {"particles", {".txt"}}};
  const auto part = kParts.find(entry.path().filename().string());
  if (part == kParts.end() || !entry.is_directory())
  {
    return isRunFile(entry.path().filename().string()) ? std::nullopt : std::optional(entry.path());
  }
  for (const fs::directory_entry& file : fs::directory_iterator(entry.path()))
  {
    const fs::path name = withoutTemporaryEnding(file.path().filename().string());
    if (part->second.count(name.extension().string()) == 0) return file.path();
  }
  return std::nullopt;
}

/// Throws for an entry that no run writes. Returns whether there is any entry besides `other`.
bool requireRunFilesOnly(const fs::path& folder, const char* other = "")
{
  bool holds_something = false;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
  {
    if (entry.path().filename() == other) continue;
    holds_something = true;
    if (const auto foreign = foreignPartOf(entry))
    {
      refuse(folder,
             "holds " + foreign->lexically_relative(folder).string() + ", which no run writes");
    }
  }
  return holds_something;
}

bool isRunSummary(const fs::path& path)
{
  std::ifstream file(path);
  const auto summary = nlohmann::json::parse(file, nullptr, false);
  return summary.is_object() && summary.contains("steps_to_first_right") &&
         summary.contains("confidently_wrong_steps");
}

/// Returns whether a run ended after the one in `other`, which may be missing or none.
bool isNewerRun(const fs::path& run, const fs::path& other)
{
  if (!isRunSummary(other / kRunSummaryFile)) return true;
  return fs::last_write_time(run / kRunSummaryFile) > fs::last_write_time(other / kRunSummaryFile);
}

/// Returns the descriptor of a folder, locked where the file system can; -1 where it is not there.
int openLocked(const fs::path& folder)
{
  const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0 || flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return file;
  close(file);
  throw std::runtime_error(folder.string() + ": another run writes here");
}

bool isSame(int file, const fs::path& folder)
{
  struct stat opened = {};
  struct stat named = {};
  return fstat(file, &opened) == 0 && stat(folder.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/// Gives two files or folders each other's name, at once where the file system can.
void exchange(const fs::path& a, const fs::path& b)
{
  if (renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return;
  if (errno != EINVAL && errno != ENOSYS && errno != EOPNOTSUPP)
  {
    throw fs::filesystem_error("exchange", a, b, std::error_code(errno, std::generic_category()));
  }
  const fs::path aside = a.string() + ".replaced";
  fs::remove_all(aside);  // of a run that was killed below, after the next one took the name
  fs::rename(b, aside);
  fs::rename(a, b);
  fs::rename(aside, a);
}

/// What has the new name so far gets the old one.
void putInPlace(const fs::path& from, const fs::path& to)
{
  if (!fs::exists(fs::symlink_status(to))) return fs::rename(from, to);
  exchange(from, to);
}

/// Removes what it can. The folder that tells the work folder of a run goes last.
void removeRun(const fs::path& folder)
{
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
  {
    if (entry.path().filename() != kMark) fs::remove_all(entry.path(), ignored);
  }
  fs::remove_all(folder, ignored);
}

/// Replaces the entries of a folder one by one, and removes those that the new run does not have.
void replaceEntries(const fs::path& work, const fs::path& results)
{
  std::set<fs::path> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(work))
    names.insert(entry.path().filename());
  for (const fs::path& name : names)
  {
    if (name != kRunSummaryFile) putInPlace(work / name, results / name);
  }
  putInPlace(work / kRunSummaryFile, results / kRunSummaryFile);
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(results))
  {
    const fs::path name = entry.path().filename();
    if (entry.path() != work && names.count(name) == 0) fs::remove_all(entry.path(), ignored);
  }
}

bool isMissing(const fs::path& folder)
{
  std::error_code unnameable;
  if (fs::is_symlink(folder, unnameable) && !fs::exists(folder, unnameable))
    throw std::runtime_error(folder.string() + ": is a link to what is not there; not overwritten");
  if (!fs::exists(folder, unnameable)) return true;
  if (!fs::is_directory(folder)) throw std::runtime_error(folder.string() + ": is not a folder");
  return false;
}
}  // namespace

void requireFinishedRun(const fs::path& folder)
{
  if (isMissing(folder)) return;
  if (euidaccess(folder.c_str(), W_OK) != 0) refuse(folder, "may not be written");
  requireUnfinishedRun(folder / kInnerWork);
  if (!requireRunFilesOnly(folder, kInnerWork)) return;
  if (isRunSummary(folder / kRunSummaryFile)) return;
  refuse(folder, std::string("is not empty, and has no ") + kRunSummaryFile +
                     " that tells an earlier run of sigloc-localize");
}

// A run makes this entry first, and a user's folder of that name hardly has one.
void requireUnfinishedRun(const fs::path& folder)
{
  std::error_code unnameable;
  if (fs::is_symlink(folder, unnameable)) refuse(folder, "is a link");
  if (isMissing(folder) || !requireRunFilesOnly(folder)) return;
  if (!fs::is_directory(folder / kMark)) refuse(folder, "is not the work folder of a run");
}

bool isOfAnotherUser(const fs::path& folder)
{
  struct stat named = {};
  return stat(folder.c_str(), &named) == 0 && named.st_uid != geteuid();
}

FolderLock::FolderLock(const fs::path& folder)
{
  while (true)
  {
    fs::create_directories(folder);
    file_ = openLocked(folder);
    // Another run may have renamed the folder, or removed it, before it let go of the lock.
    if (file_ < 0 || isSame(file_, folder)) return;
    close(file_);
  }
}

FolderLock::~FolderLock()
{
  if (file_ >= 0) close(file_);
}

void requireNoOtherRun(const fs::path& folder)
{
  const int file = openLocked(folder);
  if (file >= 0) close(file);
}

void recoverRun(const fs::path& work, const fs::path& results)
{
  if (isRunSummary(work / kRunSummaryFile) && isNewerRun(work, results)) replaceRun(work, results);
}

bool isMountPoint(const fs::path& folder)
{
  struct statx named = {};
  if (statx(AT_FDCWD, folder.c_str(), 0, 0, &named) != 0) return false;
  return (named.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
}

void replaceRun(const fs::path& work, const fs::path& results)
{
  const bool is_inside = work.parent_path() == results;
  try
  {
    (is_inside ? replaceEntries : putInPlace)(work, results);
  }
  catch (const fs::filesystem_error& error)
  {
    throw std::runtime_error(results.string() + ": cannot be replaced: " + error.code().message() +
                             "; the results are in " + work.string());
  }
  removeRun(work);
}
}  // namespace sigloc::detail
