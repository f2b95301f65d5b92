// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace sigloc::test
{
inline const std::filesystem::path kOfficeMap =
    std::filesystem::path(SIGLOC_SOURCE_DIR) / "maps" / "office.simplemap";
}  // namespace sigloc::test
