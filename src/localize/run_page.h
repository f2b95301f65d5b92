// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sigloc/localize/LocalizationRun.h"

namespace sigloc::detail
{
constexpr const char* kRunPageFile = "report.html";

/// Returns a page that shows every step of a run in a browser: the map with the hypotheses,
/// verdicts, reasons and times. It holds all of its data, and needs neither network nor other
/// files.
std::string runPage(const LocalizationRun& run);

/// The page around the data: the text before it and after it.
extern const char* const kRunPageHead;
extern const char* const kRunPageTail;
}  // namespace sigloc::detail
