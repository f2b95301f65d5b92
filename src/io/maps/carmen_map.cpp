// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "io/archive/file_fault.h"
#include "io/carmen_log.h"
#include "io/maps/map_source_readers.h"

namespace sigloc::detail
{
std::vector<PosedScans> readCarmenMap(const std::filesystem::path& path)
{
  CarmenLog log = readCarmenLog(path);
  if (log.truncated) fail(path, "its last message is cut off");
  std::vector<PosedScans> map;
  for (CarmenScan& seen : log.scans)
  {
    seen.scan.robot_from_sensor = {};
    map.push_back({seen.laser, {std::move(seen.scan)}});
  }
  return map;
}
}  // namespace sigloc::detail
