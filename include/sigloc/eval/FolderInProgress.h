// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace sigloc
{
/// A folder, made if need be, and a new one within it for files that are not yet complete. What was
/// made is gone with the object unless it was kept.
class FolderInProgress
{
 public:
  /// Throws std::runtime_error ("path: reason") where no folder can be made.
  explicit FolderInProgress(const std::filesystem::path& folder);
  ~FolderInProgress();
  FolderInProgress(const FolderInProgress&) = delete;
  FolderInProgress& operator=(const FolderInProgress&) = delete;

  /// Where the files belong until keep().
  const std::filesystem::path& part() const { return part_; }

  /// Moves the complete files to their place. Throws std::runtime_error ("path: reason").
  void keep() const;

 private:
  void removeWhatWasMade() const;

  std::filesystem::path folder_;
  std::filesystem::path part_;
  std::vector<std::filesystem::path> made_;  // deepest first
};
}  // namespace sigloc
