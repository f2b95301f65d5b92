// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sigloc::detail
{
/// While it lives, what the process writes to standard output and standard error is dropped:
/// some readers of MRPT, and the parsers beneath them, print what they also throw.
class QuietOutput
{
 public:
  QuietOutput();
  ~QuietOutput();
  QuietOutput(const QuietOutput&) = delete;
  QuietOutput& operator=(const QuietOutput&) = delete;

 private:
  int saved_output_ = -1;
  int saved_error_ = -1;
};
}  // namespace sigloc::detail
