// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/GroundTruth.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cmath>
#include <stdexcept>

#include "bridge/rawlog_files.h"

using namespace sigloc;
using namespace sigloc::test;
using mrpt::math::TPose2D;

namespace
{
std::string truthErrorOf(const std::filesystem::path& path)
{
  return messageOf<std::runtime_error>([&] { GroundTruth::read(path); });
}

void expectPose(const std::optional<TPose2D>& pose, const TPose2D& expected)
{
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->x, expected.x, 1e-12);
  EXPECT_NEAR(pose->y, expected.y, 1e-12);
  EXPECT_NEAR(pose->phi, expected.phi, 1e-12);
}
}  // namespace

TEST(GroundTruth, ReadsRowsByStep)
{
  const TemporaryFolder folder;
  writeText(folder / "t.txt", "1 2 0.1\n3 4 0.2\n");
  const GroundTruth truth = GroundTruth::read(folder / "t.txt");
  expectPose(truth.at(1, 99.0), {3, 4, 0.2});
  EXPECT_FALSE(truth.at(2, 0.0));
}

TEST(GroundTruth, ReadsRowsByIndex)
{
  const TemporaryFolder folder;
  writeText(folder / "t.txt", "# step x y phi\n0 1 2 0.1\n5 3 4 0.2\n");
  const GroundTruth truth = GroundTruth::read(folder / "t.txt");
  expectPose(truth.at(5, 0.0), {3, 4, 0.2});
  EXPECT_FALSE(truth.at(3, 0.0)) << "steps between are unknown";
}

TEST(GroundTruth, InterpolatesTimesAcrossTheTurnOfTheHeading)
{
  const TemporaryFolder folder;
  writeText(folder / "t.txt",
            "100.0 0 0 3.1\n101.0 0.2 0.4 -3.1\n105.0 0.2 0.4 -3.0\n106.0 0.2 0.4 0\n");
  const GroundTruth truth = GroundTruth::read(folder / "t.txt");
  const auto middle = truth.at(0, 100.5);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->x, 0.1, 1e-9);
  EXPECT_NEAR(middle->y, 0.2, 1e-9);
  EXPECT_NEAR(std::abs(middle->phi), M_PI, 1e-9);
  expectPose(truth.at(7, 101.0), {0.2, 0.4, -3.1});
  EXPECT_FALSE(truth.at(0, 103.0)) << "the gap is too wide";
  EXPECT_TRUE(truth.at(0, 103.0, 3.0));
  EXPECT_FALSE(truth.at(0, 99.9));
  EXPECT_FALSE(truth.at(0, 105.5)) << "who knows how it turned";
  EXPECT_FALSE(truth.at(0, 106.1));
}

TEST(GroundTruth, LeavesOutRowsWhoseTimeIsOutOfOrder)
{
  const TemporaryFolder folder;
  writeText(folder / "t.txt", "1.5 0 0 0\n9.5 5 5 1\n2.5 0.1 0 0\n3.5 0.2 0 0\n");
  const GroundTruth truth = GroundTruth::read(folder / "t.txt");
  EXPECT_FALSE(truth.at(0, 9.5));
  expectPose(truth.at(0, 2.5), {0.1, 0, 0});
}

TEST(GroundTruth, ReadsSevenColumnsAndMovesThemIntoTheMap)
{
  const TemporaryFolder folder;
  writeText(folder / "t.txt", "10.5 1 0 9 0.25 0.01 0.02\n");
  const GroundTruth truth = GroundTruth::read(folder / "t.txt", {10, 20, M_PI / 2});
  const auto pose = truth.at(0, 10.5);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->x, 10.0, 1e-9);
  EXPECT_NEAR(pose->y, 21.0, 1e-9);
  EXPECT_NEAR(pose->phi, M_PI / 2 + 0.25, 1e-9);
}

TEST(GroundTruth, ReadsTheKeyFramesOfASimplemap)
{
  mrpt::maps::CSimpleMap simplemap;
  const auto pose =
      mrpt::poses::CPose3DPDFGaussian::Create(mrpt::poses::CPose3D(1, 2, 0, 0.5, 0, 0));
  simplemap.insert(pose, makeFrame(makeScan(1000.25)));
  const TemporaryFolder folder;
  ASSERT_TRUE(simplemap.saveToFile((folder / "t.SIMPLEMAP").string()));
  const auto at = GroundTruth::read(folder / "t.SIMPLEMAP").at(0, 1000.25);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->phi, 0.5, 1e-9);
}

TEST(GroundTruth, NamesFileAndReasonForUnusableFiles)
{
  const TemporaryFolder folder;
  writeText(folder / "empty.txt", "");
  writeText(folder / "comment.txt", "# nothing\n");
  writeText(folder / "words.txt", "1 2 three\n");
  writeText(folder / "columns.txt", "1 2 3\n1 2 3 4\n");
  writeText(folder / "five.txt", "1 2 3 4 5\n");
  writeText(folder / "far.txt", "1e308 -1e308 1\n");
  writeText(folder / "m.simplemap", "noise");
  for (const char* name : {"empty.txt", "comment.txt", "words.txt", "columns.txt", "five.txt",
                           "far.txt", "m.simplemap", "no.txt"})
  {
    const std::string message = truthErrorOf(folder / name);
    EXPECT_EQ(message.rfind((folder / name).string() + ": ", 0), 0U) << name << ": " << message;
  }
  EXPECT_NE(truthErrorOf(folder / "words.txt").find("line 1"), std::string::npos);
}
