// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/particle_library.h"

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace sigloc
{
std::unique_ptr<LogTracker> loadParticleTracker(const ParticleTrackerParts& parts)
{
  // Looked for where this library looks for those that it links with. It stays loaded.
  void* const library = dlopen(SIGLOC_SLAM_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  void* const make = library == nullptr ? nullptr : dlsym(library, "siglocMakeParticleTracker");
  if (make == nullptr) throw std::runtime_error(std::string("tracker = particles: ") + dlerror());
  using Make = LogTracker*(const ParticleTrackerParts&);
  return std::unique_ptr<LogTracker>(reinterpret_cast<Make*>(make)(parts));
}
}  // namespace sigloc
