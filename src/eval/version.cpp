// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
namespace sigloc::detail
{
extern const char* const kEvalVersion;
const char* const kEvalVersion = "0.1.0";
}  // namespace sigloc::detail
