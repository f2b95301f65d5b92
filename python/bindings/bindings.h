// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace sigloc::python
{
// The parts of the module, in the order in which one needs the classes of another.

void bindMaps(pybind11::module_& module);
void bindObservations(pybind11::module_& module);
void bindLogWriting(pybind11::module_& module);
void bindResults(pybind11::module_& module);
void bindLocalizers(pybind11::module_& module);
void bindPolicy(pybind11::module_& module);
}  // namespace sigloc::python
