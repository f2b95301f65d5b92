// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "sigloc/features/Feature.h"

namespace sigloc::detail
{
void writeFeature(const Feature& feature, mrpt::serialization::CArchive& out);

/// Throws BadContent for a feature that flawOf() refuses; its parent is an index of any size.
Feature readFeature(mrpt::serialization::CArchive& in);

/// Is told how many bytes are to come, before memory is taken for what is in them. May throw.
using Announced = std::function<void(std::uint64_t bytes)>;

/// Reads their number, and that many. Throws BadContent for one that flawOf() refuses.
std::vector<Feature> readFeatures(mrpt::serialization::CArchive& in,
                                  const Announced& announced = {});
}  // namespace sigloc::detail
