// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>

#include <memory>

#include "map/building/MapBuilder.h"

namespace sigloc::detail
{
/// Stores the data of a builder, without the map that it extends.
void writeMapBuilder(const MapBuilder& builder, mrpt::serialization::CArchive& out);

/// Returns a builder that continues the stored one and extends `base` (or null). Throws
/// std::exception for a damaged archive.
MapBuilder readMapBuilder(mrpt::serialization::CArchive& in,
                          std::shared_ptr<const FeatureMap> base);
}  // namespace sigloc::detail
