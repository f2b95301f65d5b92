// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "eval/wakeup/wakeup.h"

namespace sigloc::detail
{
/// Returns what `work` returns, run in a process of its own: for methods whose random generator is
/// one for all. Only start, kidnapped_at and steps come back. Throws std::runtime_error when the
/// process fails, with what `work` threw.
///
/// Forks while other threads run, whose locks the process would inherit closed. glibc opens those
/// of malloc and stdio again. What remains are statics of functions that another thread is filling
/// at that very moment, and locks inside MRPT: the process would wait for ever. That has not been
/// seen; with one thread (`--threads 1`) it cannot happen.
Wakeup runInOwnProcess(const std::function<Wakeup()>& work);
}  // namespace sigloc::detail
