// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sigloc
{
/// The option that says where the output goes, in every program.
constexpr const char* kOut = "-o,--out";
/// The same of commands that called it --output at first.
constexpr const char* kOutOrOutput = "-o,--out,--output";
}  // namespace sigloc
