// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace sigloc
{
/// Likelihood in [0, 1] of a return, for each distance byte of a dense cell.
/// \cite algorithm eq. (6.3)
using LikelihoodTable = std::array<float, 256>;

/// Returns the table for a sigma of 0.12 m (fine) or 0.25 m (coarse).
const LikelihoodTable& fineTable();
const LikelihoodTable& coarseTable();
}  // namespace sigloc
