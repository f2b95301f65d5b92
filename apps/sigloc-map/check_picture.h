// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>

#include <string>

#include "map_check.h"
#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Returns the heat map of a check: for every place how often one scan localizes the robot, where
/// it was fooled, how far it drove, and the worst twins.
mrpt::img::CImage checkPicture(const MapCheck& check, const DenseField& field,
                               const std::string& title);
}  // namespace sigloc
