// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "eval/wakeup/wakeup.h"

namespace sigloc::detail
{
/// Runs `work` in a process of its own and returns its result. It is for methods that share one
/// random generator. Only start, kidnapped_at and steps are returned. Throws std::runtime_error
/// when the process fails, with the message that `work` threw.
///
/// Forks while other threads run, whose held locks the process inherits. glibc releases those of
/// malloc and stdio. Two cases remain in which the process would wait for ever: locks inside MRPT,
/// and static variables that another thread initializes at that moment. That has not been seen.
/// With one thread (`--threads 1`) it cannot happen.
Wakeup runInOwnProcess(const std::function<Wakeup()>& work);
}  // namespace sigloc::detail
