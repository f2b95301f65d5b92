// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/features/ObservedScene.h"
#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
/// Returns what a robot at the origin of a local map would see: the features of the map, and a full
/// circle of beams cast through its dense field. There are no beams where the map has no field, or
/// where the origin is not in its free space.
ObservedScene sceneOfMap(const FeatureMap& map);
}  // namespace sigloc
