// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/plugin/SignatureMap.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/exceptions.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/opengl/CSetOfObjects.h>

#include <cmath>
#include <stdexcept>

#include "bridge/rawlog_files.h"
#include "bridge/room_map.h"
#include "bridge/sample_maps.h"
#include "io/scan_conversion.h"
#include "sigloc/io/map_files.h"

using namespace sigloc;
using namespace sigloc::test;
using mrpt::math::TPose2D;
using mrpt::poses::CPose3D;

namespace
{
mrpt::config::CConfigFileMemory multiMapIni(const std::string& sigmap_file)
{
  mrpt::config::CConfigFileMemory ini;
  ini.setContent(
      "[M]\noccupancyGrid_count=1\nSignatureMap_count=1\n"
      "[M_SignatureMap_00_creationOpts]\nsigmap_file=" +
      sigmap_file +
      "\n[M_SignatureMap_00_insertOpts]\nmerge_gap=0.7\nmin_segment_length=0.3\n"
      "[M_SignatureMap_00_likelihoodOpts]\nsigma=0.15\n");
  return ini;
}

mrpt::maps::CMultiMetricMap multiMap(const mrpt::config::CConfigFileMemory& ini)
{
  mrpt::maps::TSetOfMetricMapInitializers initializers;
  initializers.loadFromConfigFile(ini, "M");
  mrpt::maps::CMultiMetricMap maps;
  maps.setListOfMaps(initializers);
  return maps;
}

/// A hash (FNV-1a) of the offsets of a field's cells.
std::uint32_t offsetDigest(const DenseField& field)
{
  std::uint32_t digest = 2166136261U;
  for (const DenseCell& cell : field.cells)
  {
    for (const std::int8_t byte : {cell.dx, cell.dy})
    {
      digest = (digest ^ static_cast<std::uint8_t>(byte)) * 16777619U;
    }
  }
  return digest;
}

/// The ridges of walls may differ by 0.1 m: earlier versions put them elsewhere.
void expectSameWalls(const DenseField& a, const DenseField& b)
{
  EXPECT_EQ(a.frame.origin, b.frame.origin);
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t i = 0; i < a.cells.size(); ++i)
  {
    ASSERT_EQ(a.cells[i].state(), b.cells[i].state());
    ASSERT_EQ(a.cells[i].distance(), b.cells[i].distance());
    ASSERT_NEAR(a.cells[i].dx, b.cells[i].dx, 0.1 / DenseField::kOffsetUnit);
    ASSERT_NEAR(a.cells[i].dy, b.cells[i].dy, 0.1 / DenseField::kOffsetUnit);
  }
}
}  // namespace

TEST(SignatureMap, LearnsARoomFromInsertedScans)
{
  const SignatureMap map = roomMap();
  EXPECT_FALSE(map.isEmpty());
  const auto features = map.featureMap()->features();
  const auto count = [&](FeatureType type)
  {
    return std::count_if(features.begin(), features.end(),
                         [&](const Feature& feature) { return feature.type == type; });
  };
  EXPECT_EQ(count(FeatureType::segment), 4);
  EXPECT_EQ(count(FeatureType::corner), 4);
  EXPECT_TRUE(map.featureMap()->field());
}

TEST(SignatureMap, RefusesScansWhereFloatsCannotHoldThem)
{
  SignatureMap map;
  EXPECT_FALSE(map.insertObservation(*roomScan({0, 0, 0}), CPose3D(5e5, 5e6, 0, 0, 0, 0)));
  EXPECT_NE(map.asString().find("shift the map's origin"), std::string::npos) << map.asString();
  EXPECT_TRUE(map.isEmpty());
}

TEST(SignatureMap, SaysNothingOfObservationsItDoesNotHandle)
{
  SignatureMap map = roomMap();
  const auto odometry = makeOdometry(1, {1, 2, 3});
  EXPECT_FALSE(map.canComputeObservationLikelihood(*odometry));
  EXPECT_EQ(map.computeObservationLikelihood(*odometry, CPose3D()), 0.0);
  EXPECT_FALSE(map.insertObservation(*odometry));
  EXPECT_EQ(SignatureMap().computeObservationLikelihood(*makeScan(1), CPose3D()), 0.0);
  auto blind = makeScan(1);
  for (std::size_t i = 0; i < blind->getScanSize(); ++i) blind->setScanRangeValidity(i, false);
  EXPECT_FALSE(SignatureMap().insertObservation(*blind));
  EXPECT_EQ(map.computeObservationLikelihood(*blind, CPose3D()), 0.0);
}

TEST(SignatureMap, PairsPointsWithTheNearestPlaceOnAWall)
{
  const SignatureMap map = roomMap();
  mrpt::maps::CSimplePointsMap points;
  points.insertPoint(3.8F, 0.5F);
  points.insertPoint(0.0F, 0.0F);
  mrpt::maps::TMatchingParams params;
  mrpt::maps::TMatchingExtraResults results;
  mrpt::tfest::TMatchingPairList pairs;
  map.determineMatching2D(&points, {0, 0, 0}, pairs, params, results);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].localIdx, 0U);
  EXPECT_NEAR(pairs[0].global.x, kHalfWidth, 0.05);
  EXPECT_NEAR(pairs[0].global.y, 0.5, 0.05);
  EXPECT_NEAR(results.correspondencesRatio, 0.5, 1e-6);
  const CPose3D shifted(0.2, 0, 0, 0, 0, 0);
  EXPECT_NEAR(map.compute3DMatchingRatio(&points, shifted, {}), 0.5, 1e-6);
  EXPECT_NEAR(map.compute3DMatchingRatio(&map, CPose3D(), {}), 1.0, 1e-6);
  const mrpt::maps::COccupancyGridMap2D grid;
  EXPECT_EQ(map.compute3DMatchingRatio(&grid, CPose3D(), {}), 0.0F);
}

TEST(SignatureMap, ExtendsAPreparedMap)
{
  SignatureMap map(*roomMap().featureMap());
  const std::size_t before = map.featureMap()->features().size();
  map.insertObservation(*roomScan({0, 0, 0}), CPose3D());
  map.insertObservation(*roomScan({0.5, 0, 0}), CPose3D(0.5, 0, 0, 0, 0, 0));
  EXPECT_EQ(map.featureMap()->features().size(), before) << "it knew that room";
  const CPose3D far(30, 0, 0, 0, 0, 0);
  map.insertObservation(*roomScan({0, 0, 0}), far);
  map.insertObservation(*roomScan({0.5, 0, 0}), far + CPose3D(0.5, 0, 0, 0, 0, 0));
  EXPECT_GE(map.featureMap()->features().size(), 2 * before);
  const auto scan = roomScan({0.2, 0.1, 0});
  EXPECT_GT(map.computeObservationLikelihood(*scan, far + CPose3D(0.2, 0.1, 0, 0, 0, 0)),
            map.computeObservationLikelihood(*scan, CPose3D(15, 0, 0, 0, 0, 0)));
}

TEST(SignatureMap, ClearingKeepsAPreparedMapThatTakesNoInsertions)
{
  SignatureMap map(sampleMap(30, 20));
  SignatureMap fixed(sampleMap(30, 20));
  fixed.genericMapParams.enableObservationInsertion = false;
  map.clear();
  fixed.clear();
  EXPECT_TRUE(map.isEmpty());
  EXPECT_FALSE(fixed.isEmpty());
}

TEST(SignatureMap, SurvivesSerialization)
{
  SignatureMap map = roomMap();
  map.insertion_options.building.merge_gap = 0.7;
  map.likelihood_options.points.max_points = 17;
  mrpt::io::CMemoryStream memory;
  auto archive = mrpt::serialization::archiveFrom(memory);
  archive << map;
  memory.Seek(0);
  const auto object = archive.ReadObject();
  const auto copy = std::dynamic_pointer_cast<SignatureMap>(object);
  ASSERT_TRUE(copy) << "made through the class registry";
  expectSameMap(*copy->featureMap(), *map.featureMap());
  EXPECT_EQ(copy->insertion_options.building.merge_gap, 0.7);
  EXPECT_EQ(copy->likelihood_options.points.max_points, 17U);
}

TEST(SignatureMap, LearnsOnAfterSerialization)
{
  for (const bool prepared : {false, true})
  {
    SignatureMap map = prepared ? SignatureMap(sampleMap(60, 40)) : SignatureMap();
    const auto insert = [&](SignatureMap& into, double x) {
      into.insertObservation(*roomScan({x, 0, 0.1}), CPose3D(x, 0, 0, 0.1, 0, 0));
    };
    for (const double x : {-1.5, -0.5, 0.5}) insert(map, x);
    mrpt::io::CMemoryStream memory;
    auto archive = mrpt::serialization::archiveFrom(memory);
    archive << map;
    memory.Seek(0);
    SignatureMap copy;
    archive >> copy;
    expectSameMap(*copy.featureMap(), *map.featureMap());
    for (SignatureMap* each : {&map, &copy}) insert(*each, 1.5);
    expectSameMap(*copy.featureMap(), *map.featureMap());
  }
}

TEST(SignatureMap, ReadsItsFirstVersion)
{
  mrpt::io::CFileGZInputStream file(SIGLOC_GOLDEN_FOLDER "/signature_map_v0.gz");
  auto archive = mrpt::serialization::archiveFrom(file);
  SignatureMap map;
  archive >> map;
  const FeatureMap expected = sampleMap(24, 18);
  ASSERT_EQ(map.featureMap()->features().size(), expected.features().size());
  for (std::size_t i = 0; i < expected.features().size(); ++i)
  {
    expectSameFeature(map.featureMap()->features()[i], expected.features()[i]);
  }
  expectSameWalls(*map.featureMap()->field(), *expected.field());
  EXPECT_EQ(offsetDigest(*map.featureMap()->field()), 3603488099U) << "as that version made them";
  EXPECT_EQ(map.insertion_options.building.merge_gap, 0.7);
  EXPECT_EQ(map.likelihood_options.points.max_points, 17U);
}

// A map stored by a version without the positions of hits within their cells.
TEST(SignatureMap, LearnsOnFromItsSecondVersion)
{
  mrpt::io::CFileGZInputStream file(SIGLOC_GOLDEN_FOLDER "/signature_map_v1.gz");
  auto archive = mrpt::serialization::archiveFrom(file);
  SignatureMap stored;
  archive >> stored;
  SignatureMap again(sampleMap(24, 18));
  const auto insert = [](SignatureMap& into, double x) {
    into.insertObservation(*roomScan({x, 0, 0.1}), CPose3D(x, 0, 0, 0.1, 0, 0));
  };
  for (const double x : {-1.5, -0.5, 0.5}) insert(again, x);
  for (SignatureMap* each : {&stored, &again}) insert(*each, 1.5);
  ASSERT_EQ(stored.featureMap()->features().size(), again.featureMap()->features().size());
  expectSameWalls(*stored.featureMap()->field(), *again.featureMap()->field());
}

TEST(SignatureMap, AnswersBetweenInsertionsAsIfBuiltAtOnce)
{
  SignatureMap asked_often;
  SignatureMap asked_once;
  const auto query = roomScan({0.3, 0.1, 0.2}, 9);
  const CPose3D pose(0.3, 0.1, 0, 0.2, 0, 0);
  double often = 0;
  std::vector<PosedScans> scans;
  for (int i = 0; i < 12; ++i)
  {
    const TPose2D at(0.3 * i - 1.6, 0.1 * i - 0.5, 0.2 * i);
    const auto scan = roomScan(at, i);
    const CPose3D from(at.x, at.y, 0, at.phi, 0, 0);
    scans.push_back({mrpt::poses::CPose2D(from).asTPose(), {*toLaserScan(*scan)}});
    asked_often.insertObservation(*scan, from);
    asked_once.insertObservation(*scan, from);
    often = asked_often.computeObservationLikelihood(*query, pose);
    if (i % 4 != 0) continue;
    EXPECT_GE(asked_often.featureMap()->features().size(), i > 0 ? 4U : 0U);
  }
  EXPECT_EQ(asked_once.computeObservationLikelihood(*query, pose), often);
  expectSameMap(*asked_often.featureMap(), *asked_once.featureMap());
  const SignatureMap batch(buildMapFromScans(scans));
  expectSameMap(*asked_often.featureMap(), *batch.featureMap());
  EXPECT_EQ(batch.computeObservationLikelihood(*query, pose), often);
}

TEST(SignatureMap, RefusesAPoseThatIsNone)
{
  SignatureMap map;
  const CPose3D nowhere(std::nan(""), 0, 0, 0, 0, 0);
  EXPECT_FALSE(map.insertObservation(*roomScan({0, 0, 0}), nowhere));
  EXPECT_FALSE(map.insertObservation(*roomScan({0, 0, 0}), CPose3D(2e5, 0, 0, 0, 0, 0)));
  EXPECT_TRUE(map.isEmpty());
  EXPECT_NE(map.asString().find("refused 2 scans"), std::string::npos) << map.asString();
  EXPECT_TRUE(map.insertObservation(*roomScan({0, 0, 0}), CPose3D()));
  EXPECT_FALSE(map.insertObservation(*roomScan({0, 0, 0}), CPose3D(5e4, 5e4, 0, 0, 0, 0)));
}

TEST(SignatureMap, IsMadeFromAnIniAndDeepCopiedInAMultiMap)
{
  const TemporaryFolder folder;
  const FeatureMap prepared = sampleMap(60, 40);
  saveSigmap(prepared, folder / "m.sigmap");
  mrpt::maps::CMultiMetricMap maps = multiMap(multiMapIni((folder / "m.sigmap").string()));
  auto original = maps.mapByClass<SignatureMap>();
  ASSERT_TRUE(original);
  EXPECT_EQ(maps.maps.size(), 2U) << "one grid, one signature map";
  expectSameMap(*original->featureMap(), prepared);
  EXPECT_EQ(original->insertion_options.building.merge_gap, 0.7);
  EXPECT_EQ(original->insertion_options.extraction.min_segment_length, 0.3);
  EXPECT_EQ(original->likelihood_options.points.sigma, 0.15);

  const mrpt::maps::CMultiMetricMap copy = maps;
  const auto copied = copy.mapByClass<SignatureMap>();
  ASSERT_TRUE(copied);
  EXPECT_NE(copied.get(), original.get());
  original->clear();
  expectSameMap(*copied->featureMap(), prepared);
}

TEST(SignatureMap, RefusesUnknownKeysAndBadFiles)
{
  auto ini = multiMapIni("");
  ini.write("M_SignatureMap_00_likelihoodOpts", "sgima", 0.2);
  try
  {
    multiMap(ini);
    ADD_FAILURE() << "an unknown key was accepted";
  }
  catch (const std::exception& error)
  {
    const std::string shown = mrpt::exception_to_str(error);  // as stock programs do
    EXPECT_NE(shown.find("likelihoodOpts: unknown key 'sgima'"), std::string::npos) << shown;
  }
  ini = multiMapIni("");
  ini.write("M_SignatureMap_00_insertOpts", "merge_gap", "much");
  EXPECT_THROW(multiMap(ini), std::exception);
  EXPECT_THROW(multiMap(multiMapIni("/nonexistent.sigmap")), std::exception);
}

TEST(SignatureMap, WritesItsOptionsAsItReadsThem)
{
  SignatureMap::TInsertionOptions options;
  options.building.merge_gap = 0.9;
  options.extraction.split_distance = 0.08;
  mrpt::config::CConfigFileMemory ini;
  options.saveToConfigFile(ini, "s");
  SignatureMap::TInsertionOptions read;
  read.loadFromConfigFile(ini, "s");
  EXPECT_EQ(read.building.merge_gap, 0.9);
  EXPECT_EQ(read.extraction.split_distance, 0.08);
}

TEST(SignatureMap, DrawsItselfAndWritesASigmap)
{
  const SignatureMap map = roomMap();
  mrpt::opengl::CSetOfObjects scene;
  map.getVisualizationInto(scene);
  EXPECT_FALSE(scene.empty());
  const TemporaryFolder folder;
  map.saveMetricMapRepresentationToFile((folder / "out").string());
  expectSameMap(loadSigmap(folder / "out.sigmap"), *map.featureMap());
}
