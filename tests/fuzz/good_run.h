// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eval/protocols/relocate.h"
#include "eval/reports/report_files.h"

namespace sigloc::fuzz
{
/// A small run of `sigloc-eval relocate`, as mergeRuns() takes it.
inline RelocateReport goodRun(std::uint64_t seed)
{
  RelocateReport report;
  report.provenance.seed = seed;
  report.methods.emplace_back();
  report.methods.back().name = "signature";
  for (std::size_t i = 0; i < 4; ++i)
  {
    RelocationRecord record;
    record.query = std::to_string(i);
    record.truth = mrpt::math::TPose2D(1, 2, 0.5);
    record.first = mrpt::math::TPose2D(1.25, 2, 0.5);
    record.error = {0.25, 0};
    record.valid_beams = 181;
    record.rank_of_right = i < 2 ? 1 : 0;
    record.proposed = true;
    record.claim = i % 2 == 0 ? Claim::none : Claim::right;
    record.time_ms = 1;
    report.methods.back().records.push_back(record);
  }
  return report;
}
}  // namespace sigloc::fuzz
