// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace sigloc::detail
{
constexpr const char* kRunSummaryFile = "summary.json";
constexpr const char* kInnerWork = ".partial";  ///< work folder where none can be made beside it

/// Throws std::runtime_error ("folder: reason") unless `folder` is missing, empty or the output of
/// a finished run of sigloc-localize, and may be written. Such an output has only the files of a
/// run, and its summary among them.
void requireFinishedRun(const std::filesystem::path& folder);

/// The same for the folder that a run works in, which is no link.
void requireUnfinishedRun(const std::filesystem::path& folder);

/// True for a folder that exists and belongs to another user than this process runs as.
bool isOfAnotherUser(const std::filesystem::path& folder);

/// Makes a run the only one that writes into a folder as long as the object exists. The folder may
/// be renamed meanwhile. On a file system without locks the object has no effect.
class FolderLock
{
 public:
  /// Makes the folder if it is not there. Throws std::runtime_error ("folder: another run writes
  /// here") for one that is locked, and std::filesystem::filesystem_error where none can be made.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

/// Throws the same for a folder that is locked. One that does not exist is not.
void requireNoOtherRun(const std::filesystem::path& folder);

/// Gives the whole run in `work`, a folder beside `results`, the name that its program could not
/// give it, or was killed before it did. Does nothing where the run in `results` is newer. Throws
/// as replaceRun().
void recoverRun(const std::filesystem::path& work, const std::filesystem::path& results);

/// True for a folder that another file system, or another part of one, is mounted on. It cannot be
/// renamed.
bool isMountPoint(const std::filesystem::path& folder);

/// Puts the whole run in `work`, a folder beside `results` or in it, in the place of the run in
/// `results`, if there is one. A folder beside it takes its name at once, and then the earlier run
/// is removed. In it, one file after the other is replaced, the summary last. Wherever the program
/// is killed, nothing of the new run is lost, and `results` has a summary. Where the file system
/// cannot exchange names, `results` may be missing then; recoverRun() mends that. What cannot be
/// removed stays in `work`. Throws std::runtime_error ("folder: reason") where `results` cannot be
/// replaced; a `work` beside it is whole then.
void replaceRun(const std::filesystem::path& work, const std::filesystem::path& results);
}  // namespace sigloc::detail
