// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>

#include <string>
#include <vector>

#include "map_alignment.h"

namespace sigloc
{
/// Returns map a with the walls of b in red, at the first pose. Of every pose there is the outline
/// of b with its number.
mrpt::img::CImage alignmentPicture(const DenseField& a, const DenseField& b,
                                   const std::vector<MapPose>& poses, const std::string& title);
}  // namespace sigloc
