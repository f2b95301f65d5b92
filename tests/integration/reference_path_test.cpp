// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/data/reference_path.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "bridge/rawlog_files.h"
#include "eval/scoring/relocation_scoring.h"
#include "io/GroundTruth.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc
{
namespace
{
const std::filesystem::path kSource = SIGLOC_SOURCE_DIR;
const std::filesystem::path kMap = kSource / "maps" / "office.simplemap";
const std::filesystem::path kRawlog = kSource / "rawlogs" / "office.rawlog";

TEST(ReferencePath, FollowsTheTruthBackFromTheEnd)
{
  const GroundTruth truth = GroundTruth::read(kSource / "rawlogs" / "office-truth.txt");
  RawlogReader log(kRawlog);
  double end = 0;
  std::size_t steps = 0;
  for (; const auto step = log.next(); ++steps) end = step->time;
  const auto known = truth.at(steps - 1, end);
  ASSERT_TRUE(known);

  // Known to a decimetre only.
  const ReferencePath found =
      referencePath(kMap, kRawlog, {known->x + 0.1, known->y - 0.05, known->phi + 0.03});
  ASSERT_EQ(found.poses.size(), steps);
  EXPECT_GT(found.worst_goodness, 0.6);
  for (std::size_t i = 0; i < found.poses.size(); ++i)
  {
    const PoseError error =
        errorBetween(found.poses[i].map_from_robot, *truth.at(i, found.poses[i].time));
    EXPECT_LT(error.distance, 0.1) << "step " << i;
    EXPECT_LT(mrpt::RAD2DEG(error.angle), 2) << "step " << i;
  }

  const test::TemporaryFolder folder;
  writeReferencePath(found, folder / "truth.txt");
  const auto read = GroundTruth::read(folder / "truth.txt").at(3, found.poses[3].time);
  ASSERT_TRUE(read);
  EXPECT_NEAR(read->x, found.poses[3].map_from_robot.x, 1e-3);
  EXPECT_NO_THROW(checkReferenceFile(folder / "truth.txt")) << "an earlier one is replaced";
}

TEST(ReferencePath, ReplacesNothingElse)
{
  const test::TemporaryFolder folder;
  EXPECT_NO_THROW(checkReferenceFile(folder / "truth.txt"));
  for (const char* const text : {"", "1 2 3 4\n", "# time x y phi\n1 2 3 4\n"})
  {
    test::writeText(folder / "truth.txt", text);
    EXPECT_THROW(checkReferenceFile(folder / "truth.txt"), std::runtime_error) << text;
  }
  EXPECT_THROW(checkReferenceFile(folder.path()), std::runtime_error);
}

TEST(ReferencePath, RefusesWhatItCannotFollow)
{
  EXPECT_THROW(referencePath(kSource / "maps" / "office.gridmap.gz", kRawlog, {}),
               std::runtime_error);
  EXPECT_THROW(referencePath(kMap, kSource / "none.rawlog", {}), std::runtime_error);
}
}  // namespace
}  // namespace sigloc
