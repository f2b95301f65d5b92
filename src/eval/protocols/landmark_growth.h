// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eval/protocols/scale.h"

namespace sigloc::detail
{
/// The growth study on the DLR log, `options.dlr`. The queries are local maps of
/// `options.local_map_steps` steps from later visits. Where the map's size varies, it is the part
/// of the first half's map nearest to the query. Where the scene's size varies, thinned scenes are
/// searched in the whole of it. Throws std::runtime_error ("path: reason") for its files.
ScaleReport runLandmarkGrowth(const ScaleOptions& options);
}  // namespace sigloc::detail
