// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eval/data/csv_table.h"
#include "eval/scoring/relocation_scoring.h"

namespace sigloc::detail
{
/// Reads a row back that `relocationCsvRow` wrote, to the digits that it wrote.
/// Throws std::runtime_error ("path: line N: reason").
RelocationRecord storedRelocation(const CsvTable& results, std::size_t row);
}  // namespace sigloc::detail
