// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint3D.h>

#include <filesystem>
#include <optional>
#include <vector>

namespace sigloc::detail
{
using PointList = std::vector<mrpt::math::TPoint3Df>;

// One reader a file format, plain or compressed. Points without three finite coordinates are left
// out, as in organised clouds. All throw std::runtime_error "path: reason".

/// Reads the vertices of a PLY file: as text, or binary in either order of bytes.
PointList readPly(const std::filesystem::path& path);

/// Reads a PCD file of version 0.6 or later: as text, binary, or binary and compressed.
PointList readPcd(const std::filesystem::path& path);

/// Reads rows `x y [z] ...` of a text file that holds points rather than landmarks, or nullopt.
///
/// It does where most rows have another within 0.15 m: landmarks that near to each other could not
/// be told apart. A first row that names columns must name x, y and z first. Without one there must
/// be at least 100 rows. Throws for points among which a row is no number or has fewer or more
/// columns than the first.
std::optional<PointList> pointRowsOf(const std::filesystem::path& path);
}  // namespace sigloc::detail
