// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/feature_archive.h"

#include <limits>
#include <string>

#include "features/feature_values.h"
#include "io/archive_values.h"

namespace sigloc::detail
{
using mrpt::serialization::CArchive;

void writeFeature(const Feature& feature, CArchive& out)
{
  out << static_cast<std::uint8_t>(feature.type) << static_cast<std::uint8_t>(feature.side)
      << feature.start_seen << feature.end_seen << feature.position.x << feature.position.y
      << feature.direction << feature.size << feature.position_covariance(0, 0)
      << feature.position_covariance(0, 1) << feature.position_covariance(1, 0)
      << feature.position_covariance(1, 1) << feature.direction_variance << feature.size_variance
      << feature.label << feature.sightings << feature.parent;
}

namespace
{
constexpr std::uint64_t kFeatureBytes = 96;  // of one, as writeFeature() writes it

Feature readFields(CArchive& in)
{
  Feature feature;
  std::uint8_t type = 0;
  std::uint8_t side = 0;
  auto& covariance = feature.position_covariance;
  in >> type >> side;
  feature.start_seen = readFlag(in);
  feature.end_seen = readFlag(in);
  in >> feature.position.x >> feature.position.y >> feature.direction >> feature.size >>
      covariance(0, 0) >> covariance(0, 1) >> covariance(1, 0) >> covariance(1, 1) >>
      feature.direction_variance >> feature.size_variance >> feature.label >> feature.sightings >>
      feature.parent;
  feature.type = static_cast<FeatureType>(type);
  feature.side = static_cast<WallSide>(side);
  return feature;
}
}  // namespace

Feature readFeature(CArchive& in)
{
  const Feature feature = readFields(in);
  if (const auto flaw = flawOf(feature, std::numeric_limits<std::int32_t>::max()))
  {
    throw BadContent("a feature " + *flaw);
  }
  return feature;
}

std::vector<Feature> readFeatures(CArchive& in, const Announced& announced)
{
  std::uint32_t count = 0;
  in >> count;
  if (announced) announced(kFeatureBytes * count);
  std::vector<Feature> features;
  Crowding crowding;
  // Grown as they come: a hostile count must not allocate memory that the file has no data for.
  for (std::uint32_t k = 0; k < count; ++k)
  {
    features.push_back(readFields(in));
    auto flaw = flawOf(features.back(), count);
    if (!flaw) flaw = crowding.add(features.back());
    if (flaw)
    {
      throw BadContent("feature " + std::to_string(k) + " " + *flaw);
    }
  }
  return features;
}
}  // namespace sigloc::detail
