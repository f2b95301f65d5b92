// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/feature_archive.h"

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>

#include <stdexcept>

#include "bridge/sample_maps.h"

using namespace sigloc;
using namespace sigloc::test;

namespace
{
Feature archived(const Feature& feature)
{
  mrpt::io::CMemoryStream memory;
  auto archive = mrpt::serialization::archiveFrom(memory);
  detail::writeFeature(feature, archive);
  memory.Seek(0);
  return detail::readFeature(archive);
}
}  // namespace

TEST(FeatureArchive, KeepsAFeatureOfEachType)
{
  Feature feature = sampleFeatures().back();
  for (const FeatureTraits& traits : kFeatureTraits)
  {
    feature.type = traits.type;
    expectSameFeature(archived(feature), feature);
  }
}

TEST(FeatureArchive, RefusesATypeBeyondTheLast)
{
  Feature feature;
  feature.type = FeatureType::count;
  EXPECT_THROW(archived(feature), std::runtime_error);
}
