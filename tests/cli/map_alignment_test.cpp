// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// sigloc-align: the pose of one map in another.
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPosePDFSOG.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>

#include "command_line.h"
#include "io/key_frames.h"
#include "picture_pixels.h"
#include "sigloc/geometry/GaussianPose.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
using mrpt::math::TPose2D;

const TPose2D kTurned(12, -7, 73 * M_PI / 180);  // of the second map in the first

/// Writes every `of`-th key frame of a map from `first` on, turned and shifted by the inverse of a
/// pose.
void writePart(const std::filesystem::path& source, const TPose2D& a_from_b, std::size_t of,
               std::size_t first, const std::filesystem::path& path)
{
  mrpt::maps::CSimpleMap whole;
  ASSERT_TRUE(whole.loadFromFile(source.string()));
  const mrpt::poses::CPose3D a_from_b_3d(a_from_b.x, a_from_b.y, 0, a_from_b.phi, 0, 0);
  mrpt::maps::CSimpleMap part;
  for (std::size_t i = first; i < whole.size(); i += of)
  {
    const KeyFrame entry = keyFrameOf(whole, i);
    const auto turned = mrpt::poses::CPose3DPDFGaussian::Create();
    turned->copyFrom(*entry.pose);
    turned->mean = turned->mean - a_from_b_3d;
    part.insert(turned, mrpt::obs::CSensoryFrame::Create(*entry.frame));
  }
  ASSERT_TRUE(part.saveToFile(path.string()));
}

mrpt::poses::CPosePDFSOG posesIn(const std::filesystem::path& path)
{
  mrpt::io::CFileGZInputStream file(path.string());
  mrpt::poses::CPosePDFSOG poses;
  mrpt::serialization::archiveFrom(file) >> poses;
  return poses;
}

void expectFirstPose(const mrpt::poses::CPosePDFSOG& poses, const TPose2D& truth)
{
  ASSERT_GE(poses.size(), 1U);
  const PoseError error = errorBetween(poses.get(0).mean.asTPose(), truth);
  EXPECT_LT(error.distance, 0.1);
  EXPECT_LT(error.angle, 0.5 * M_PI / 180);
}

TEST(MapAlignment, aTurnedMapIsFoundInItsOriginal)
{
  const TemporaryFolder folder;
  writePart(kLabMap, kTurned, 1, 0, folder / "turned.simplemap");
  const CommandResult result = run(
      folder, "sigloc-align",
      {kLabMap.string(), "turned.simplemap", "--poses", "out.CPosePDFSOG", "--picture", "out.png"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  expectFirstPose(posesIn(folder / "out.CPosePDFSOG"), kTurned);
  mrpt::img::CImage picture;
  ASSERT_TRUE(picture.loadFromFile((folder / "out.png").string()));
  EXPECT_GT(pixelsLike(picture, mrpt::img::TColor(215, 30, 30)), 3000) << "walls of the second map";
  // Equal walls lie on each other: hardly one of the first map is left to see.
  EXPECT_LT(pixelsLike(picture, mrpt::img::TColor(150, 150, 150)), 8000);
}

TEST(MapAlignment, aFolderTakesPosesAndPicture)
{
  const TemporaryFolder folder;
  const std::string lab = kLabMap.string();
  ASSERT_EQ(run(folder, "sigloc-align", {lab, lab, "-o", "answer", "--places", "20"}).exit_code, 0);
  expectFirstPose(posesIn(folder / "answer/poses.CPosePDFSOG"), {});
  mrpt::img::CImage picture;
  EXPECT_TRUE(picture.loadFromFile((folder / "answer/align.png").string()));
}

TEST(MapAlignment, outputsThatCannotBeWrittenAreToldFirst)
{
  const TemporaryFolder folder;
  const std::string lab = kLabMap.string();
  writeText(folder / "my_map.yaml", "image: x\n");
  std::filesystem::create_directory(folder / "folder.png");
  const auto before = listing(folder);
  for (const auto& [arguments, reason] : std::vector<std::pair<Arguments, std::string>>{
           {{"--poses", "p.CPosePDFSOG", "--picture", "no/a.png"},
            "no/a.png: there is no folder no"},
           {{"--poses", "no/p.CPosePDFSOG"}, "no/p.CPosePDFSOG: there is no folder no"},
           {{"--picture", "folder.png"}, "folder.png: is a folder"},
           {{"--out", "new", "--picture", "no/a.png"}, "no/a.png: there is no folder no"},
           {{"--out", "my_map.yaml"}, "my_map.yaml: is no folder"}})
  {
    Arguments all = {lab, lab};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const CommandResult result = run(folder, "sigloc-align", all);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.output, "") << "nothing is computed";
    EXPECT_EQ(result.errors, "sigloc-align: " + reason + "\n");
    EXPECT_EQ(listing(folder), before);
  }
  EXPECT_EQ(run(folder, "sigloc-align",
                {lab, lab, "-o", "new/", "--poses", "new/p.CPosePDFSOG", "--places", "20"})
                .exit_code,
            0);
}

TEST(MapAlignment, aMapOfOtherScansOfThePlaceIsFound)
{
  const TemporaryFolder folder;
  writePart(kLabMap, {}, 2, 0, folder / "even.simplemap");
  writePart(kLabMap, kTurned, 2, 1, folder / "odd.simplemap");
  ASSERT_EQ(
      run(folder, "sigloc-align", {"even.simplemap", "odd.simplemap", "--poses", "out.CPosePDFSOG"})
          .exit_code,
      0);
  expectFirstPose(posesIn(folder / "out.CPosePDFSOG"), kTurned);
}

TEST(MapAlignment, everyPosePossibleIsTold)
{
  const TemporaryFolder folder;
  ASSERT_EQ(run(folder, "sigloc-simulate",
                {"--world", "corridor", "--seed", "5", "--metres", "5", "--out", "corridor"})
                .exit_code,
            0);
  const std::string corridor = (folder / "corridor/map.simplemap").string();
  ASSERT_EQ(
      run(folder, "sigloc-align", {corridor, corridor, "--poses", "out.CPosePDFSOG"}).exit_code, 0);
  const auto poses = posesIn(folder / "out.CPosePDFSOG");
  EXPECT_GE(poses.size(), 2U) << "the rooms repeat along the corridor";
}

double weightsIn(const std::filesystem::path& path)
{
  double sum = 0;
  for (const auto& mode : posesIn(path)) sum += std::exp(mode.log_w);
  return sum;
}

// Offices have rooms in common. What few places agree with is no sure pose, in the file neither.
TEST(MapAlignment, whatFewPlacesAgreeWithIsToldAndWeighsLittle)
{
  const TemporaryFolder folder;
  for (const char* seed : {"13", "14"})
  {
    ASSERT_EQ(
        run(folder, "sigloc-simulate", {"--seed", seed, "--metres", "5", "--out", seed}).exit_code,
        0);
  }
  const CommandResult result = run(
      folder, "sigloc-align", {"13/map.simplemap", "14/map.simplemap", "--poses", "p.CPosePDFSOG"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.errors.find("of its places agree with a pose"), std::string::npos)
      << result.errors;
  EXPECT_LT(weightsIn(folder / "p.CPosePDFSOG"), 0.5);
  const Arguments itself = {"13/map.simplemap", "13/map.simplemap", "--poses", "q.CPosePDFSOG"};
  EXPECT_EQ(run(folder, "sigloc-align", itself).errors, "");
  EXPECT_GT(weightsIn(folder / "q.CPosePDFSOG"), 0.5);
}

TEST(MapAlignment, anotherBuildingIsNotFound)
{
  const TemporaryFolder folder;
  const CommandResult result = run(
      folder, "sigloc-align", {kLabMap.string(), kOffice.string(), "--poses", "out.CPosePDFSOG"});
  EXPECT_EQ(result.exit_code, 3) << result.output;
  EXPECT_NE(result.output.find("no pose"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "out.CPosePDFSOG"));
}

TEST(MapAlignment, wrongUseIsRefusedInOneLine)
{
  const TemporaryFolder folder;
  std::string marks;
  for (int i = 0; i < 12; ++i) marks += std::to_string(i) + " " + std::to_string(i * i) + "\n";
  writeText(folder / "marks.csv", marks);
  const std::string lab = kLabMap.string();
  const auto refused = [&](const Arguments& arguments, const std::string& why)
  {
    const CommandResult result = run(folder, "sigloc-align", arguments);
    EXPECT_EQ(result.exit_code, 1) << why;
    EXPECT_EQ(countLines(result.errors), 1) << result.errors;
    EXPECT_NE(result.errors.find(why), std::string::npos) << result.errors;
  };
  refused({lab}, "B");
  refused({lab, "marks.csv"}, "marks.csv");
  refused({lab, lab, "--poses", "out.txt"}, "must end in .CPosePDFSOG");
  refused({lab, lab, "--pose", "out.CPosePDFSOG"}, "did you mean '--poses'");
}
}  // namespace
}  // namespace sigloc
