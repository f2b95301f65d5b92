// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sigloc::detail
{
/// While an object exists, the output of the process to standard output and standard error is
/// dropped. Some readers of MRPT, and the parsers that they use, print the errors that they also
/// throw.
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
