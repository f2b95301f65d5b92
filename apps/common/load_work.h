// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sigloc
{
/// Whether what is asked for may take pictures. Those need OSMesa, which must be loaded before
/// everything that brings a libGL.
enum class Pictures
{
  none,
  perhaps,
};

/// Loads the library that does this program's work, with MRPT and all that comes along, and returns
/// its function `name`. Throws std::runtime_error where that fails.
void* loadFunction(const char* name, Pictures pictures);

/// The same by type: loadWork<decltype(siglocAlign)>("siglocAlign", ...)(arguments).
template <class Function>
Function* loadWork(const char* name, Pictures pictures)
{
  return reinterpret_cast<Function*>(loadFunction(name, pictures));
}
}  // namespace sigloc
