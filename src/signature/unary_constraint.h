// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "signature/DirectedFeature.h"

namespace sigloc
{
/// Returns true when an observed feature may be a mapped one by itself: same type and label, same
/// size (a radius or an opening) within the gate, an observed wall no longer than the mapped one.
/// `gate` is the chi-square gate with one degree of freedom. \cite algorithm eq. (3.1)
bool unaryCompatible(const DirectedFeature& observed, const DirectedFeature& mapped, double gate);
}  // namespace sigloc
