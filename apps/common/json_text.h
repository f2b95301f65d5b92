// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace sigloc
{
/// Returns JSON over several lines, with its end of line. The names of files may be no UTF-8, which
/// JSON must be: such bytes are replaced.
inline std::string jsonText(const nlohmann::ordered_json& json)
{
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}
}  // namespace sigloc
