// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "progress_line.h"
#include "sigloc/localize/LocalizationRun.h"

namespace sigloc
{
/// Shows the progress of a run: one line rewritten in place on a terminal, a line for every tenth
/// elsewhere, nothing when quiet.
class Progress
{
 public:
  explicit Progress(bool quiet);
  /// The share of the map that is built.
  void showMap(double share) { line_.showBar("building the map", share); }
  void show(const LocalizationRun& run);
  /// Ends the rewritten line.
  void finish() { line_.finish(); }

 private:
  bool quiet_;
  ProgressLine line_;
  double next_line_ = 0;  // share of the log at which one is due, where nothing is rewritten
};

/// Returns a line on what of a log was left out, empty for nothing.
std::string leftOutLine(const LeftOutOfLog& left_out);

/// Returns the table that ends a run.
std::string summaryTable(const LocalizationRun& run);
}  // namespace sigloc
