// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The module `sigloc._sigloc`. Its docstrings are those of sigloc/__init__.pyi.
#include "bindings/bindings.h"

PYBIND11_MODULE(_sigloc, module)
{
  module.attr("__version__") = SIGLOC_VERSION;
  sigloc::python::bindMaps(module);
  sigloc::python::bindObservations(module);
  sigloc::python::bindLogWriting(module);
  sigloc::python::bindResults(module);
  sigloc::python::bindLocalizers(module);
  sigloc::python::bindPolicy(module);
}
