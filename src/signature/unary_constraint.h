// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "signature/DirectedFeature.h"

namespace sigloc
{
/// Returns true when an observed feature may be a mapped one by itself. Type and label must be the
/// same, and so must a radius or an opening within the gate. An observed wall must not be longer
/// than the mapped one. `gate` is the chi-square gate with one degree of freedom.
/// \cite algorithm eq. (3.1)
bool unaryCompatible(const DirectedFeature& observed, const DirectedFeature& mapped, double gate);
}  // namespace sigloc
