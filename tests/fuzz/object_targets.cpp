// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of MRPT's objects and of ours.
#include <mrpt/serialization/CArchive.h>

#include <new>

#include "fuzz/small_room.h"
#include "fuzz/targets.h"
#include "io/archive/checked_archive.h"
#include "io/maps/map_source_readers.h"
#include "sigloc/io/map_files.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/plugin/ObservationSignatures.h"
#include "sigloc/plugin/SignatureMap.h"

namespace sigloc::fuzz
{
namespace
{
using mrpt::serialization::CSerializable;

/// Reads an object as a host does, by MRPT's archive. Null where it is refused by an exception; out
/// of memory is no refusal.
template <class Object>
std::shared_ptr<Object> read(std::string_view bytes)
{
  const auto path = inputFile("object", bytes);
  auto object = std::make_shared<Object>();
  try
  {
    detail::GzipInput input(path);
    auto archive = mrpt::serialization::archiveFrom(input);
    archive.ReadObject(object.get());
    return object;
  }
  catch (const std::bad_alloc&)
  {
    throw Finding("an object that takes all memory");
  }
  catch (const std::exception&)
  {
    return nullptr;
  }
}

/// A map that was accepted must be usable: by a matcher, unless it is so large that this takes
/// long.
void useMap(const FeatureMap& map)
{
  constexpr std::size_t kMostFeatures = 300;
  constexpr std::size_t kMostCells = 200000;
  if (map.features().size() > kMostFeatures) return;
  if (map.field() && map.field()->cells.size() > kMostCells) return;
  const auto shared = std::make_shared<const FeatureMap>(map);
  requireLaws(matcherIn(shared)->localize(observeScene({scanInRoom({-2, 0, 0.3})})));
}
}  // namespace

bool readsSigmap(std::string_view bytes)
{
  const auto path = inputFile("map.sigmap", bytes);
  return accepts([&] { useMap(loadSigmap(path)); });
}

bool readsSignatureMap(std::string_view bytes)
{
  const auto map = read<SignatureMap>(bytes);
  if (!map) return false;
  if (map->featureMap()) useMap(*map->featureMap());
  const auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->aperture = 3;
  scan->resizeScanAndAssign(31, 2.0F, true);
  map->computeObservationLikelihood(*scan, mrpt::poses::CPose3D());
  map->insertObservation(*scan);
  return true;
}

bool readsSignatures(std::string_view bytes)
{
  const auto object = read<ObservationSignatures>(bytes);
  if (!object) return false;
  object->signatures();
  object->exportTxtDataRow();
  return true;
}

bool readsRawlog(std::string_view bytes)
{
  const auto path = inputFile("steps.rawlog", bytes);
  std::size_t steps = 0;
  const bool read = accepts(
      [&]
      {
        RawlogReader reader(path);
        while (const auto step = reader.next())
        {
          observe(*step);
          ++steps;
        }
      });
  return read && steps > 0;
}

bool readsMapFile(std::string_view bytes)
{
  const auto path = inputFile("map.simplemap", bytes);
  const bool scans = accepts(
      [&]
      {
        for (const PosedScans& posed : detail::readSimplemap(path)) observeScene(posed.scans);
      });
  return scans || accepts([&] { detail::readGridmap(path); });
}
}  // namespace sigloc::fuzz
