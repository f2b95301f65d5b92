// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A drive through an office in the map of another building. Whoever reads one file of the output
// alone cannot take any step of it for a localized one.
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CText3D.h>
#include <mrpt/poses/CPosePDFSOG.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "command_line.h"
#include "runs.h"
#include "sigloc/matching/RelocationResult.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
using nlohmann::json;

constexpr double kSureSigma = 0.5;  // [m] a pose may be taken for sure below
constexpr std::ptrdiff_t kOfficeSteps = 202;

class UnsurePoses : public testing::Test
{
 protected:
  void SetUp() override
  {
    writeConfig(folder_, kLabMap.string(), (kSources / "rawlogs/office.rawlog").string());
    result_ = localize(folder_);
    ASSERT_EQ(result_.exit_code, 0) << result_.errors;
    const json summary = summaryOf(folder_);
    ASSERT_EQ(summary["localized_steps"], 0) << "the premise of these tests";
  }

  std::string text(const std::string& name) const { return readBytes(folder_ / "out" / name); }

  TemporaryFolder folder_;
  CommandResult result_;
};

/// Every observation of the log's sensory frames.
std::vector<mrpt::obs::CObservation::Ptr> observationsIn(const std::filesystem::path& path)
{
  std::vector<mrpt::obs::CObservation::Ptr> all;
  mrpt::obs::CRawlog log;
  EXPECT_TRUE(log.loadFromRawLogFile(path.string()));
  for (std::size_t i = 0; i < log.size(); ++i)
  {
    if (log.getType(i) != mrpt::obs::CRawlog::etSensoryFrame) continue;
    for (const auto& observation : *log.getAsObservations(i)) all.push_back(observation);
  }
  return all;
}

void expectNoSureBelief(const json& belief)
{
  EXPECT_EQ(belief["source"], "sigloc");
  EXPECT_NE(belief["verdict"], "localized");
  EXPECT_FALSE(belief["reason"].get<std::string>().empty());
  EXPECT_FALSE(belief["features"].empty());
  double sum = belief["elsewhere"];
  for (const json& hypothesis : belief["hypotheses"])
  {
    sum += hypothesis["probability"].get<double>();
    EXPECT_EQ(hypothesis["covariance"].size(), 9U);
  }
  EXPECT_NEAR(sum, 1, 1e-6);
  EXPECT_EQ(belief["first_pose_probability"].is_null(), belief["hypotheses"].empty());
}

TEST_F(UnsurePoses, theRawlogLabelsThemAndKeepsThemWide)
{
  std::size_t poses = 0;
  std::ptrdiff_t beliefs = 0;
  for (const auto& observation : observationsIn(folder_ / "out/annotated.rawlog"))
  {
    if (const auto pose = std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(observation))
    {
      EXPECT_EQ(pose->sensorLabel, "sigloc_unsure");
      EXPECT_GT(std::sqrt(pose->pose.cov(0, 0) + pose->pose.cov(1, 1)), kSureSigma);
      ++poses;
    }
    const auto comment = std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(observation);
    if (!comment) continue;
    expectNoSureBelief(json::parse(comment->text));
    ++beliefs;
  }
  EXPECT_GT(poses, 100U);
  EXPECT_EQ(beliefs, kOfficeSteps);
}

TEST_F(UnsurePoses, thePathHoldsNoneOfThem)
{
  EXPECT_EQ(countLines(text("path.tum")), 1) << "a comment";
  EXPECT_GT(countLines(text("path_unsure.tum")), 100);
  EXPECT_NE(text("path_unsure.tum").find("NOT LOCALIZED"), std::string::npos);
}

TEST_F(UnsurePoses, pfLocalizationsFilesShowHowWideTheBeliefIs)
{
  std::istringstream rows(text("cov_est.txt"));
  constexpr double kSureVolume = kSureSigma * kSureSigma * 0.5;  // [m^2 rad]
  std::ptrdiff_t count = 0;
  for (std::string row; std::getline(rows, row); ++count)
  {
    const double volume = std::stod(row);
    EXPECT_TRUE(std::isnan(volume) || volume > kSureVolume) << count << ": " << row;
  }
  EXPECT_EQ(count, kOfficeSteps);
}

TEST_F(UnsurePoses, theBeliefFilesHoldSomewhereElse)
{
  std::ptrdiff_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "out/belief"))
  {
    if (entry.path().extension() != ".CPosePDFSOG") continue;
    mrpt::poses::CPosePDFSOG belief;
    mrpt::io::CFileGZInputStream file(entry.path().string());
    mrpt::serialization::archiveFrom(file) >> belief;
    ASSERT_FALSE(belief.empty()) << entry.path();
    EXPECT_GT(belief[belief.size() - 1].cov(0, 0), 10.0) << entry.path();
    const auto [covariance, mean] = belief.getCovarianceAndMean();
    EXPECT_GT(std::sqrt(covariance(0, 0) + covariance(1, 1)), kSureSigma) << entry.path();
    ++count;
  }
  EXPECT_EQ(count, kOfficeSteps);
}

TEST_F(UnsurePoses, theTerminalAndTheSummarySayWhy)
{
  EXPECT_NE(result_.output.find("NOT LOCALIZED: "), std::string::npos) << result_.output;
  EXPECT_NE(result_.output.find("\nwhy not sure "), std::string::npos) << result_.output;
  EXPECT_NE(result_.output.find("0 of 202 steps, 0.0 of 45."), std::string::npos) << result_.output;
  const json summary = summaryOf(folder_);
  EXPECT_TRUE(summary["confidently_wrong_steps"].is_null()) << "no truth was given";
  EXPECT_NE(summary["final_verdict"], "localized");
  EXPECT_LT(summary["final_pose"].is_null() ? 0.0 : summary["final_pose_probability"].get<double>(),
            0.99);
  EXPECT_FALSE(summary["final_reason"].get<std::string>().empty());
  EXPECT_EQ(summary["times_lost"], 0);
}

// The number in brackets is that of the first pose, whatever the verdict.
TEST(PoseInBrackets, isHowProbableTheFirstPoseIs)
{
  const TemporaryFolder folder;
  std::size_t with_pose = 0;
  for (const auto& map : {kLabMap, kDatasets / "malaga-cs-fac-building.simplemap.gz"})
  {
    const CommandResult result =
        run(folder, "sigloc-localize",
            {"--map", map.string(), "--log", kLabLog.string(), "--out", "out", "--quiet"});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const json summary = summaryOf(folder);
    std::string expected = summary["final_verdict"];
    expected = (expected == "localized" ? "" : "NOT LOCALIZED: ") + expected;
    if (summary["final_pose"].is_null())
    {
      expected += " (no pose)\n";
    }
    else
    {
      ++with_pose;
      expected += " (" + probabilityText(summary["final_pose_probability"].get<double>()) +
                  "), first hypothesis";
    }
    EXPECT_NE(result.output.find(expected), std::string::npos)
        << expected << " in " << result.output;
  }
  EXPECT_GE(with_pose, 1U) << "the premise of this test";
}

TEST_F(UnsurePoses, everySceneSaysSoBesideThePose)
{
  std::size_t with_pose = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "out/3D"))
  {
    mrpt::opengl::COpenGLScene scene;
    ASSERT_TRUE(scene.loadFromFile(entry.path().string()));
    if (!scene.followCamera()) continue;  // there is no pose
    const auto label = scene.getByClass<mrpt::opengl::CText3D>();
    ASSERT_TRUE(label) << entry.path();
    EXPECT_EQ(label->getString(), "NOT LOCALIZED");
    ++with_pose;
  }
  EXPECT_GE(with_pose, 1U) << "the premise of this test";
}

TEST_F(UnsurePoses, everyPictureHasTheRedFrame)
{
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "out/pictures"))
  {
    if (entry.path().filename() == "contact_sheet.png") continue;  // of pictures with frames
    mrpt::img::CImage picture;
    ASSERT_TRUE(picture.loadFromFile(entry.path().string()));
    const auto* const corner =
        picture.ptr<std::uint8_t>(static_cast<unsigned>(picture.getWidth() - 2),
                                  static_cast<unsigned>(picture.getHeight() - 2));
    const bool bgr = picture.getChannelsOrder() == "BGR";
    EXPECT_EQ(corner[bgr ? 2 : 0], 210) << entry.path();
    EXPECT_EQ(corner[1], 0) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 2U);
}
}  // namespace
}  // namespace sigloc
