// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eval/protocols/sweep.h"
#include "eval/reports/report_files.h"

namespace sigloc
{
/// All that the report of a sweep holds.
RunReport sweepRunReport(const SweepReport& report);
}  // namespace sigloc
