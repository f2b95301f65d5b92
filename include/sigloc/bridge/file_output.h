// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace mrpt::serialization
{
class CArchive;
}

namespace sigloc
{
// How every file is written: the bytes go to a temporary file beside it, which takes the file's
// name, or that of the file a link points to, once they are all on the disk. What cannot be written
// leaves what was there as it was, and is told as std::runtime_error ("path: cannot be written:
// reason").

/// Writes a file of these bytes.
void writeFile(const std::filesystem::path& path, std::string_view bytes);

constexpr int kQuickCompression = 1;
constexpr int kBestCompression = 9;

/// Writes what `write` puts into an archive, gz-compressed by zlib's level `compression`.
void writeObjects(const std::filesystem::path& path,
                  const std::function<void(mrpt::serialization::CArchive&)>& write,
                  int compression = kQuickCompression);

/// The name of a file whose temporary file, perhaps left by a run that was killed, is called
/// `name`; any other name is returned as it is.
std::string withoutTemporaryEnding(const std::string& name);

/// Throws std::runtime_error when anything printed to `out`, the standard output, got lost.
void finishOutput(std::ostream& out);
}  // namespace sigloc
