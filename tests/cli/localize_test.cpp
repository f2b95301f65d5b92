// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CSetOfTriangles.h>
#include <mrpt/opengl/CText3D.h>
#include <mrpt/poses/CPosePDFSOG.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "picture_pixels.h"
#include "runs.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/plugin/map_drawing.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
using nlohmann::json;

/// Keys of a run without pictures, with where the robot is at the end of the lab's log.
const std::string kLabTruth =
    std::string(kNoPictures) +
    "use_final_truth = true\n"
    "final_truth_x = 15.90\nfinal_truth_y = -10.01\nfinal_truth_phi_deg = 4.9\n";

void writeLabConfig(const TemporaryFolder& folder, const std::string& rawlog)
{
  writeConfig(folder, kLabMap.string(), rawlog, kLabTruth);
}

std::ptrdiff_t beliefsWithAPose(const TemporaryFolder& folder)
{
  std::ptrdiff_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "out/belief"))
  {
    if (entry.path().extension() != ".CPosePDFSOG") continue;
    mrpt::poses::CPosePDFSOG belief;
    mrpt::io::CFileGZInputStream file(entry.path().string());
    mrpt::serialization::archiveFrom(file) >> belief;
    if (!belief.empty()) ++count;
  }
  return count;
}

TEST(Localize, writesACompleteOutputFolder)
{
  const TemporaryFolder folder;
  writeLabConfig(folder, kLabLog.string());
  const CommandResult result = localize(folder);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.errors, "");
  EXPECT_EQ(result.output.rfind("map ", 0), 0U) << result.output;  // the table, nothing before it

  const json summary = summaryOf(folder);
  EXPECT_EQ(summary["steps"], kLabSteps);
  EXPECT_EQ(summary["truncated"], false);
  EXPECT_EQ(summary["map_reused"], false);
  EXPECT_GT(summary["map_features"], 10);

  EXPECT_EQ(beliefsWithAPose(folder), kLabSteps);
  const std::ptrdiff_t rows = countLines(readBytes(folder / "out/path.tum")) +
                              countLines(readBytes(folder / "out/path_unsure.tum"));
  EXPECT_EQ(rows, kLabSteps + 2) << "each with a comment";
  EXPECT_EQ(countLines(readBytes(folder / "out/steps.csv")), kLabSteps + 1);
  EXPECT_FALSE(std::filesystem::exists(folder / "out.partial"));
}

TEST(Localize, endsRightInTheLab)
{
  const TemporaryFolder folder;
  writeLabConfig(folder, kLabLog.string());
  ASSERT_EQ(localize(folder).exit_code, 0);
  const json summary = summaryOf(folder);
  EXPECT_EQ(summary["final_verdict"], "localized");
  EXPECT_LT(summary["final_error_m"], 0.5);
  EXPECT_LT(summary["final_error_deg"], 5);
  EXPECT_TRUE(summary["confidently_wrong_steps"].is_null()) << "of the path no truth is known";
  EXPECT_GT(summary["localized_steps"], kLabSteps / 2);
  EXPECT_GT(summary["localized_m"], 0);
  EXPECT_LE(summary["localized_m"], summary["distance_m"]);
}

TEST(Localize, tracksWithParticlesWhenAsked)
{
  const TemporaryFolder folder;
  writeConfig(
      folder, kLabMap.string(), kLabLog.string(),
      "tracker = particles // MRPT's filter\n[sigloc.particles]\nparticles = 200\n" + kLabTruth);
  ASSERT_EQ(localize(folder).exit_code, 0);
  const json summary = summaryOf(folder);
  EXPECT_EQ(summary["final_verdict"], "localized");
  EXPECT_LT(summary["final_error_m"], 0.5);
  const std::string path = readBytes(folder / "out/path.tum");
  ASSERT_EQ(localize(folder).exit_code, 0);
  EXPECT_EQ(readBytes(folder / "out/path.tum"), path) << "a function of the seed";
}

TEST(Localize, annotatesLogsOfActionsAndFrames)
{
  const TemporaryFolder folder;
  writeLabConfig(folder, kLabLog.string());
  ASSERT_EQ(localize(folder).exit_code, 0);
  std::size_t annotations = 0;
  mrpt::obs::CRawlog log;
  ASSERT_TRUE(log.loadFromRawLogFile((folder / "out/annotated.rawlog").string()));
  for (std::size_t i = 0; i < log.size(); ++i)
  {
    if (log.getType(i) != mrpt::obs::CRawlog::etSensoryFrame) continue;
    const auto frame = log.getAsObservations(i);
    const auto pose = frame->getObservationByClass<mrpt::obs::CObservationRobotPose>();
    if (!pose) continue;
    EXPECT_EQ(pose->sensorLabel, "sigloc");
    ++annotations;
  }
  EXPECT_EQ(annotations, beliefsWithAPose(folder));
  mrpt::obs::CRawlog original;
  ASSERT_TRUE(original.loadFromRawLogFile(kLabLog.string()));
  EXPECT_EQ(log.size(), original.size());
}

TEST(Localize, annotatesLogsOfObservations)
{
  const TemporaryFolder folder;
  std::vector<mrpt::serialization::CSerializable::Ptr> objects;
  RawlogReader reader(kLabLog);
  mrpt::poses::CPose2D odometry;
  double time = 1000;
  while (auto step = reader.next())
  {
    if (step->motion) odometry = odometry + mrpt::poses::CPose2D(step->motion->mean);
    objects.push_back(makeOdometry(time, odometry));
    auto scan = step->frame->getObservationByClass<mrpt::obs::CObservation2DRangeScan>();
    scan->timestamp = mrpt::Clock::fromDouble(time);
    objects.push_back(scan);
    time += 1;
  }
  writeObjects(folder / "observations.rawlog", objects);
  writeLabConfig(folder, "observations.rawlog");
  ASSERT_EQ(localize(folder).exit_code, 0);
  EXPECT_EQ(summaryOf(folder)["steps"], kLabSteps);
  EXPECT_EQ(summaryOf(folder)["final_verdict"], "localized");

  mrpt::obs::CRawlog log;
  ASSERT_TRUE(log.loadFromRawLogFile((folder / "out/annotated.rawlog").string()));
  std::size_t annotations = 0;
  for (std::size_t i = 0; i < log.size(); ++i)
  {
    const auto pose =
        std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(log.getAsGeneric(i));
    if (!pose) continue;
    ++annotations;
    ASSERT_GT(i, 0U);
    EXPECT_EQ(pose->timestamp, log.getAsObservation(i - 1)->timestamp);
  }
  EXPECT_EQ(annotations, beliefsWithAPose(folder));
}

TEST(Localize, reusesTheUnchangedMapAndReplacesItsOwnFolder)
{
  const TemporaryFolder folder;
  writeLabConfig(folder, kLabLog.string());
  ASSERT_EQ(localize(folder).exit_code, 0);
  const auto first = listing(folder);
  const std::string first_path = readBytes(folder / "out/path.tum");
  ASSERT_EQ(localize(folder).exit_code, 0);
  EXPECT_EQ(summaryOf(folder)["map_reused"], true);
  EXPECT_EQ(listing(folder), first);
  EXPECT_EQ(readBytes(folder / "out/path.tum"), first_path);
}

TEST(Localize, neverReplacesWhatItDidNotWrite)
{
  const TemporaryFolder folder;
  writeLabConfig(folder, kLabLog.string());
  ASSERT_EQ(localize(folder).exit_code, 0);
  writeText(folder / "out/belief/notes.tex", "mine");
  const CommandResult result = localize(folder);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.errors.find("not overwritten"), std::string::npos) << result.errors;
  EXPECT_EQ(readBytes(folder / "out/belief/notes.tex"), "mine");

  std::filesystem::remove(folder / "out/belief/notes.tex");
  std::filesystem::create_directory(folder / "out.partial");
  writeText(folder / "out.partial/notes.tex", "mine too");
  EXPECT_EQ(localize(folder).exit_code, 1);
  EXPECT_EQ(readBytes(folder / "out.partial/notes.tex"), "mine too");
}

TEST(Localize, saysThatATruncatedLogWasCovered)
{
  const TemporaryFolder folder;
  makeBadFile(Damage::truncated, kLabLog, folder / "cut.rawlog");
  writeLabConfig(folder, "cut.rawlog");
  const CommandResult result = localize(folder);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(countLines(result.errors), 1) << result.errors;
  EXPECT_NE(result.errors.find("cut.rawlog"), std::string::npos);
  const json summary = summaryOf(folder);
  EXPECT_EQ(summary["truncated"], true);
  EXPECT_GT(summary["steps"], 0);
  EXPECT_LT(summary["steps"], kLabSteps);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/annotated.rawlog"));
}

TEST(Localize, leavesOutWhatIsBrokenAndSaysSo)
{
  const TemporaryFolder folder;
  std::vector<mrpt::serialization::CSerializable::Ptr> log;
  for (int i = 0; i < 4; ++i)
  {
    mrpt::math::CMatrixDouble33 covariance;
    log.push_back(makeAction({i == 2 ? 1e30 : 0.1, 0, 0}, covariance));
    const auto scan = makeScan(i);
    if (i == 1) scan->sensorPose = {std::nan(""), 0, 0, 0, 0, 0};
    log.push_back(makeFrame(scan));
  }
  writeObjects(folder / "broken.rawlog", log);
  writeLabConfig(folder, "broken.rawlog");
  const CommandResult result = localize(folder);
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(countLines(result.errors), 1) << result.errors;
  for (const char* told : {"broken.rawlog", "1 observation left out", "1 motion taken for unknown"})
  {
    EXPECT_NE(result.errors.find(told), std::string::npos) << result.errors;
  }
  EXPECT_EQ(summaryOf(folder)["steps"], 3);
  EXPECT_LT(summaryOf(folder)["distance"], 1.0);
}

TEST(Localize, takesAScanWithoutAnyValidBeam)
{
  const TemporaryFolder folder;
  auto blind = makeScan(1);
  for (std::size_t i = 0; i < blind->getScanSize(); ++i) blind->setScanRangeValidity(i, false);
  writeObjects(folder / "blind.rawlog", {blind});
  writeLabConfig(folder, "blind.rawlog");
  const CommandResult result = localize(folder);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.errors, "");
  EXPECT_EQ(summaryOf(folder)["final_verdict"], "too little seen");
  EXPECT_TRUE(summaryOf(folder)["final_pose"].is_null());
}

TEST(Localize, knowsNoDistanceWithoutOdometry)
{
  const TemporaryFolder folder;
  writeObjects(folder / "still.rawlog", {makeScan(1), makeScan(2), makeScan(3)});
  writeLabConfig(folder, "still.rawlog");
  const CommandResult result = localize(folder);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.output.find("3 steps, distance unknown"), std::string::npos) << result.output;
  EXPECT_TRUE(summaryOf(folder)["distance_m"].is_null());
  EXPECT_TRUE(summaryOf(folder)["localized_after_m"].is_null());
}

TEST(Localize, runsStockConfigurationsUnchanged)
{
  const TemporaryFolder folder;
  const CommandResult result =
      run(folder, "sigloc-localize",
          {"/usr/share/mrpt/config_files/pf-localization/localization_demo.ini", "--quiet"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(countLines(result.errors), 1) << result.errors;
  for (const char* const ignored :
       {"SHOW_PROGRESS_3D_REAL_TIME", "particles_count", "[PF_options]"})
  {
    EXPECT_NE(result.errors.find(ignored), std::string::npos) << result.errors;
  }
  const auto pictures = folder / "LOG_LOCALIZATION/pictures";
  mrpt::img::CImage picture;
  ASSERT_TRUE(picture.loadFromFile((pictures / "step_00037_end.png").string()));
  EXPECT_GE(picture.getWidth() * picture.getHeight(), 1280U * 960U);
  EXPECT_GT(pixelsLike(picture, mrpt::img::TColor(31, 78, 160)), 500) << "walls";
  EXPECT_GT(pixelsLike(picture, Palette::kReturns), 100) << "returns";
  EXPECT_GT(pixelsLike(picture, Palette::kSurePose), 50) << "chosen pose";
  const std::string page = readBytes(folder / "LOG_LOCALIZATION/report.html");
  EXPECT_NE(page.find(R"("mapped":"#1f4ea0","returns":"#e11e1e","observed":"#ff8c00")"),
            std::string::npos)
      << "the page has the colours of the pictures";
  EXPECT_GT(pixelsLike(picture, mrpt::img::TColor(255, 255, 255)), 10000) << "free space";
  // The first relocation and the end at least: two columns of pictures 900 pixels wide.
  mrpt::img::CImage sheet;
  ASSERT_TRUE(sheet.loadFromFile((pictures / "contact_sheet.png").string()));
  EXPECT_EQ(sheet.getWidth(), 2U * 900 + 30);
  EXPECT_GT(pixelsLike(sheet, mrpt::img::TColor(255, 255, 255)), 10000) << "free space";
}

/// Expects that no object is wider than stock viewers can tell to be in view; returns their number.
std::size_t expectSmallObjects(const mrpt::opengl::CSetOfObjects& objects)
{
  std::size_t count = 0;
  for (const auto& object : objects)
  {
    if (const auto inner = std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(object))
    {
      count += expectSmallObjects(*inner);
    }
    if (!std::dynamic_pointer_cast<mrpt::opengl::CSetOfTriangles>(object)) continue;
    const auto box = object->getBoundingBox();
    EXPECT_LT(box.max.x - box.min.x, 25);
    EXPECT_LT(box.max.y - box.min.y, 25);
    ++count;
  }
  return count;
}

// MRPT's viewers hide an object whose corners are all out of view, and start at the scene's camera.
TEST(Localize, scenesShowTheRobotInStockViewers)
{
  const TemporaryFolder folder;
  writeLabConfig(folder, kLabLog.string());
  ASSERT_EQ(localize(folder).exit_code, 0);
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile((folder / "out/3D/step_00037.3Dscene").string()));
  std::size_t objects = 0;
  for (const auto& object : *scene.getViewport())
  {
    const auto set = std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(object);
    if (set) objects += expectSmallObjects(*set);
  }
  EXPECT_GT(objects, 10U);
  EXPECT_TRUE(scene.followCamera());
  EXPECT_FALSE(scene.getByClass<mrpt::opengl::CText3D>()) << "it is localized";
  const auto& camera = scene.getViewport()->getCamera();
  const json pose = summaryOf(folder)["final_pose"];
  EXPECT_NEAR(camera.getPointingAtX(), pose[0].get<double>(), 0.01);
  EXPECT_NEAR(camera.getPointingAtY(), pose[1].get<double>(), 0.01);
}

TEST(Localize, writesOnlyTheFiguresWhenAsked)
{
  const TemporaryFolder folder;
  writeConfig(folder, kLabMap.string(), kLabLog.string(),
              "SAVE_STATS_ONLY = true\n3DSceneFrequency = 5\n");
  for (int i = 0; i < 2; ++i)  // the second replaces the first
  {
    ASSERT_EQ(localize(folder).exit_code, 0);
    for (const char* const name : {"summary.json", "steps.csv", "path.tum", "cov_est.txt"})
    {
      EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
    }
    for (const char* const name : {"belief", "3D", "pictures", "particles"})
    {
      const bool empty = !std::filesystem::exists(folder / "out" / name) ||
                         std::filesystem::is_empty(folder / "out" / name);
      EXPECT_TRUE(empty) << name;
    }
  }
}

TEST(Localize, saysThatNothingIsWritten)
{
  const TemporaryFolder folder;
  writeLabConfig(folder, kLabLog.string());
  const CommandResult result = run(folder, "sigloc-localize", {"run.ini", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.output.find("\nwritten to              nothing"), std::string::npos)
      << result.output;
  EXPECT_EQ(listing(folder).size(), 1U) << "the ini";
}

TEST(Localize, saysThatAReadyMapIsLoaded)
{
  const TemporaryFolder folder;
  ASSERT_EQ(
      run(folder, "sigloc-map", {"build", "-i", kLabMap.string(), "-o", "lab.sigmap"}).exit_code,
      0);
  writeConfig(folder, "lab.sigmap", kLabLog.string());
  const CommandResult result = run(folder, "sigloc-localize", {"run.ini", "--quiet"});
  EXPECT_NE(result.output.find(" features, loaded in "), std::string::npos) << result.output;
}
}  // namespace
}  // namespace sigloc
