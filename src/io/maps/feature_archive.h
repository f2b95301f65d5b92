// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>

#include "sigloc/features/Feature.h"

namespace sigloc::detail
{
void writeFeature(const Feature& feature, mrpt::serialization::CArchive& out);

/// Throws std::runtime_error for a type that is not known.
Feature readFeature(mrpt::serialization::CArchive& in);
}  // namespace sigloc::detail
