// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

namespace sigloc
{
/// Makes a folder if need be and moves into it what `fill` writes into the folder that it is given,
/// all of it or, throwing, nothing: then what was made is removed. A message that `fill` throws
/// names the place the file was meant for. What a run that was killed has left is removed, too;
/// those that still run hold a lock on theirs.
///
/// Throws std::runtime_error ("path: reason") where nothing can be made, and what `fill` throws.
void fillFolder(const std::filesystem::path& folder,
                const std::function<void(const std::filesystem::path& part)>& fill);
}  // namespace sigloc
