// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "io/carmen_log.h"
#include "io/maps/map_source_readers.h"

namespace sigloc::detail
{
std::vector<PosedScans> readCarmenLog(const std::filesystem::path& path)
{
  std::vector<PosedScans> map;
  for (CarmenScan& seen : readCarmenScans(path))
  {
    seen.scan.robot_from_sensor = {};
    map.push_back({seen.laser, {std::move(seen.scan)}});
  }
  return map;
}
}  // namespace sigloc::detail
