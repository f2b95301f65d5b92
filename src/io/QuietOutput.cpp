// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/QuietOutput.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace sigloc::detail
{
namespace
{
int redirected(int descriptor, int target)
{
  const int saved = fcntl(descriptor, F_DUPFD_CLOEXEC, 3);
  if (saved >= 0) dup2(target, descriptor);
  return saved;
}

void restore(int descriptor, int saved)
{
  if (saved < 0) return;
  dup2(saved, descriptor);
  close(saved);
}
}  // namespace

QuietOutput::QuietOutput()
{
  std::fflush(nullptr);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  saved_output_ = redirected(STDOUT_FILENO, nowhere);
  saved_error_ = redirected(STDERR_FILENO, nowhere);
  close(nowhere);
}

QuietOutput::~QuietOutput()
{
  std::fflush(nullptr);
  restore(STDOUT_FILENO, saved_output_);
  restore(STDERR_FILENO, saved_error_);
}
}  // namespace sigloc::detail
