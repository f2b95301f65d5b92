// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>

#include <filesystem>

#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
/// Writes a `.sigmap` (gz-compressed, versioned, checksummed) atomically: to a temporary file that
/// is renamed. Throws std::runtime_error naming the path and the reason.
void saveSigmap(const FeatureMap& map, const std::filesystem::path& path);

/// Reads a `.sigmap` of this or an earlier version. Throws std::runtime_error naming the path and
/// the reason for a missing, truncated, corrupt or foreign file, and for a map that reaches beyond
/// 100 km of its origin.
FeatureMap loadSigmap(const std::filesystem::path& path);

/// The body of a `.sigmap` and of a serialized `SignatureMap`.
void writeFeatureMap(const FeatureMap& map, mrpt::serialization::CArchive& out);
FeatureMap readFeatureMap(mrpt::serialization::CArchive& in);
}  // namespace sigloc
