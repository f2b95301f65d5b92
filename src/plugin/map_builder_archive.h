// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>

#include <memory>

#include "map/building/MapBuilder.h"

namespace sigloc::detail
{
/// Stores what a builder has gathered, without the map it stands on.
void writeMapBuilder(const MapBuilder& builder, mrpt::serialization::CArchive& out);

/// Returns a builder that goes on where the stored one has ended, on top of `base` (or null).
/// Throws std::exception for a damaged archive.
MapBuilder readMapBuilder(mrpt::serialization::CArchive& in,
                          std::shared_ptr<const FeatureMap> base);
}  // namespace sigloc::detail
