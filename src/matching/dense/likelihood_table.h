// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace sigloc
{
/// Likelihood of a return at each distance byte of a dense cell.
using LikelihoodTable = std::array<float, 256>;

/// Of a return 0.12 m (fine) or 0.25 m (coarse) wide.
const LikelihoodTable& fineTable();
const LikelihoodTable& coarseTable();
}  // namespace sigloc
