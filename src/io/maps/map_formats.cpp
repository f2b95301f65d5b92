// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Programs name the formats in their help, before they load the library. So nothing is called here
// that needs MRPT's libraries.
#include "io/maps/map_formats.h"

#include <fmt/format.h>

#include "sigloc/io/map_files.h"

namespace sigloc
{
namespace detail
{
const std::vector<MapFormat>& mapFormats()
{
  static const std::vector<MapFormat> kFormats = {
#define SIGLOC_ROW(kind, reader, name, ...) {MapKind::kind, name, {__VA_ARGS__}},
      SIGLOC_MAP_FORMATS(SIGLOC_ROW)
#undef SIGLOC_ROW
  };
  return kFormats;
}
}  // namespace detail

std::string mapFormatNames()
{
  std::string names;
  for (const detail::MapFormat& format : detail::mapFormats())
  {
    names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", format.name,
                         fmt::join(format.extensions, " "));
  }
  return names;
}
}  // namespace sigloc
