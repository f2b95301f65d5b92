// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eval/protocols/scale.h"

namespace sigloc::detail
{
/// The growth study on the DLR log, `options.dlr`: later visits asked for with local maps of
/// `options.local_map_steps`, in the part of the first half's map nearest to the place that was
/// asked for, as large as wanted; scenes thinned in the whole of it.
/// Throws std::runtime_error ("path: reason") for its files.
ScaleReport runLandmarkGrowth(const ScaleOptions& options);
}  // namespace sigloc::detail
