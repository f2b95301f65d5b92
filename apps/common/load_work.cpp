// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "load_work.h"

#include <dlfcn.h>

#include <sstream>
#include <stdexcept>
#include <string>

namespace sigloc
{
void* loadFunction(const char* name, Pictures pictures)
{
  // Where it cannot be loaded, the first picture says so.
  if (pictures == Pictures::perhaps) dlopen(SIGLOC_OSMESA, RTLD_NOW | RTLD_GLOBAL);
  // Most of the time goes into the search for symbols. A library looks for its own in all that it
  // is loaded with, so the largest ones are loaded by themselves first. Without that all works,
  // slower.
  std::istringstream large(SIGLOC_LOADED_FIRST);
  for (std::string library; large >> library;) dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  // All of it stays loaded.
  void* const work = dlopen("$ORIGIN/" SIGLOC_WORK, RTLD_NOW | RTLD_LOCAL);
  void* const function = work == nullptr ? nullptr : dlsym(work, name);
  if (function == nullptr) throw std::runtime_error(dlerror());
  return function;
}
}  // namespace sigloc
