// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace mrpt::serialization
{
class CArchive;
}

namespace sigloc
{
// How every file is written: the bytes go to a temporary file beside it. Once they are all on the
// disk, it is renamed to the file, or to the file that a link points to. A failed write leaves the
// earlier file as it was and throws std::runtime_error ("path: cannot be written: reason").

/// When the bytes go to the disk itself, so that a power cut cannot take them back.
enum class Durability
{
  at_once,  ///< before the file has its name
  with_folder,  ///< when syncFolder() is called, for the many files of a folder
};

/// Writes a file of these bytes.
void writeFile(const std::filesystem::path& path, std::string_view bytes,
               Durability durability = Durability::at_once);

/// How a file of objects is compressed. MRPT reads gzip in all its versions.
enum class Packing
{
  quick_gzip,
  small_gzip,
  zstd,  ///< read in a quarter of the time, for files that sigloc alone reads
};

/// Writes what `write` puts into an archive, compressed.
void writeObjects(const std::filesystem::path& path,
                  const std::function<void(mrpt::serialization::CArchive&)>& write,
                  Packing packing = Packing::quick_gzip,
                  Durability durability = Durability::at_once);

/// Waits until all that was written in a folder is on the disk. Throws like writeFile().
void syncFolder(const std::filesystem::path& folder);

/// The name of a file whose temporary file, perhaps left by a run that was killed, is called
/// `name`; any other name is returned as it is.
std::string withoutTemporaryEnding(const std::string& name);

/// Throws std::runtime_error when anything printed to `out`, the standard output, got lost.
void finishOutput(std::ostream& out);

// Checks that a program makes before its work, which may take hours. They leave nothing behind.
// They ensure that it can write, and replaces only what an earlier run of it left.

/// Throws std::runtime_error ("folder: reason") unless a folder can be written into, or be made.
void checkWritableFolder(const std::filesystem::path& folder);

/// Throws std::runtime_error ("file: reason") unless a file can be written. Its folder must exist.
void checkWritableFile(const std::filesystem::path& file);

/// Throws std::runtime_error ("output: reason") when writing `output` would destroy one of
/// `inputs`. `output` is a file, or a folder that is replaced with all it holds. An input is
/// destroyed when it is the same file, by whatever path or link, or lies below the folder. Inputs
/// that are empty or do not exist are ignored.
void refuseToReplaceInputs(const std::filesystem::path& output,
                           const std::vector<std::filesystem::path>& inputs);

/// Which files a program may replace in an output folder that it shares with other files.
struct OutputFolderRule
{
  /// Whether a run may write an entry of this name.
  std::function<bool(const std::string& name)> writes;
  /// Whether an earlier run wrote such entries of the folder.
  std::function<bool(const std::filesystem::path& folder)> is_own;
  std::string owner;  ///< whose runs, for the message
};

/// Throws std::runtime_error ("folder: reason") when a run that writes into `folder` could replace
/// one of `inputs`, or an entry that no earlier run wrote. So it does where `folder` is a file. A
/// folder that is not there is fine.
void checkOutputFolder(const std::filesystem::path& folder, const OutputFolderRule& rule,
                       const std::vector<std::filesystem::path>& inputs);

/// Returns a message in one line: without the source positions and stack traces that MRPT's
/// exceptions add, and with '?' for control characters, which a file's name may hold. The middle of
/// one of more than 1000 characters, such as a huge value that is quoted, is left out.
std::string oneLine(const std::string& message);
}  // namespace sigloc
