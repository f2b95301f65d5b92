// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "sigloc/eval/track.h"

namespace sigloc::detail
{
/// Returns what `work` returns, run in a process of its own: for methods whose random generator is
/// one for all. Only start, kidnapped_at and steps come back. Throws std::runtime_error when the
/// process fails, with what `work` threw.
TrackRun runInOwnProcess(const std::function<TrackRun()>& work);
}  // namespace sigloc::detail
