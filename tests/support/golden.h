// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <string_view>

namespace sigloc::test
{
/// True where what tests compare with is to be written anew, as scripts/update_golden asks for. A
/// variable that is set to something else must not do so: no comparison could then fail.
inline bool writesGolden()
{
  const char* const value = std::getenv("SIGLOC_UPDATE_GOLDEN");
  return value != nullptr && std::string_view(value) == "1";
}
}  // namespace sigloc::test
