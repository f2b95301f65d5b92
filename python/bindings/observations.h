// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "sigloc/features/ObservedScene.h"

namespace sigloc::python
{
/// Landmarks of one step, in the robot's frame.
struct Landmarks
{
  std::vector<Feature> features;
};

/// What a Scan, a Landmarks, or a sequence of these shows. Raises TypeError for other objects.
ObservedScene sceneOf(const pybind11::object& observations);
}  // namespace sigloc::python
