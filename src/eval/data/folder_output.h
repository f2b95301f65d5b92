// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

namespace sigloc
{
/// Makes a folder if need be. `fill` writes into a temporary folder that it is given, whose files
/// are moved into the real one when it returns. If it throws, nothing is moved and all that was
/// made is removed. A message that `fill` throws names the path that the file was meant for. Files
/// left by a run that was killed are removed, too. Runs that go on hold a lock on theirs.
///
/// Throws std::runtime_error ("path: reason") where nothing can be made, and what `fill` throws.
void fillFolder(const std::filesystem::path& folder,
                const std::function<void(const std::filesystem::path& part)>& fill);
}  // namespace sigloc
