// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/sweep.h"

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "bridge/rawlog_files.h"
#include "eval/protocols/swept_quantities.h"

namespace sigloc
{
namespace
{
using test::readBytes;
using test::TemporaryFolder;

SweepOptions smallSweep(const std::string& over, std::vector<double> values)
{
  SweepOptions options;
  options.over = over;
  options.values = std::move(values);
  options.worlds = {WorldKind::corridor};
  options.worlds_per_kind = 1;
  options.queries_per_world = 6;
  options.methods = {"signature"};
  options.seed = 11;
  options.command = "test";
  return options;
}

// results.csv without its last column, which is the time.
std::string resultsWithoutTimes(const SweepReport& report)
{
  const TemporaryFolder folder;
  writeSweepReport(report, folder.path());
  std::istringstream file(readBytes(folder / "results.csv"));
  std::string out;
  for (std::string line; std::getline(file, line);) out += line.substr(0, line.rfind(',')) + "\n";
  return out;
}

TEST(Sweep, GivesTheSameResultsOnOneAndTwoThreads)
{
  SweepOptions options = smallSweep("furniture", {1});
  options.methods = {"signature", "exhaustive", "lattice"};
  const std::string one = resultsWithoutTimes(runSweep(options));
  options.threads = 2;
  EXPECT_EQ(one, resultsWithoutTimes(runSweep(options)));
  options.methods = {"signature"};
  const std::string signature = resultsWithoutTimes(runSweep(options));
  EXPECT_EQ(one.rfind(signature, 0), 0U);
  options.seed = 12;
  EXPECT_NE(signature, resultsWithoutTimes(runSweep(options)));
}

TEST(Sweep, AsksEveryMethodTheSameQueriesAndEveryValueTheSamePlaces)
{
  SweepOptions options = smallSweep("clutter", {0, 0.3});
  options.methods = {"signature", "lattice"};
  const SweepReport report = runSweep(options);
  ASSERT_EQ(report.rows.size(), 4U);
  for (const SweepRow& row : report.rows)
  {
    ASSERT_EQ(row.records.size(), 6U);
    for (std::size_t i = 0; i < row.records.size(); ++i)
    {
      const auto& reference = report.rows.front().records[i].answer;
      EXPECT_EQ(row.records[i].answer.truth->x, reference.truth->x);
      EXPECT_EQ(row.records[i].answer.truth->phi, reference.truth->phi);
    }
  }
}

TEST(Sweep, CountsEveryConfidentAnswerThatIsNotRightAsWrong)
{
  const AccuracyGates gates = simulationGates();
  EXPECT_EQ(judgeClaim(PoseError{0.4, mrpt::DEG2RAD(5.0)}, gates), Claim::right);
  EXPECT_EQ(judgeClaim(PoseError{0.6, mrpt::DEG2RAD(5.0)}, gates), Claim::wrong);
  EXPECT_EQ(judgeClaim(PoseError{0.1, mrpt::DEG2RAD(11.0)}, gates), Claim::wrong);
}

TEST(Sweep, KeepsTheFirstFailures)
{
  // No method finds a robot by a laser with a range of 1 m.
  SweepOptions options = smallSweep("range", {1});
  options.keep_failures = 2;
  const SweepReport report = runSweep(options);
  ASSERT_EQ(report.rows.front().failures.size(), 2U);
  for (const FailedQuery& failure : report.rows.front().failures)
  {
    EXPECT_TRUE(isFailure(failure.record));
    EXPECT_EQ(failure.query.name.rfind("corridor-11000-", 0), 0U) << failure.query.name;
    EXPECT_NE(failure.map, nullptr);
  }
}

TEST(Sweep, WritesARowForEachValueAndMethod)
{
  SweepOptions options = smallSweep("map-noise", {0, 0.1});
  options.methods = {"signature", "lattice"};
  const TemporaryFolder folder;
  writeSweepReport(runSweep(options), folder.path());
  const auto json = nlohmann::json::parse(readBytes(folder / "summary.json"));
  EXPECT_EQ(json.at("over"), "map-noise");
  for (const char* method : {"signature", "lattice"})
  {
    const auto& entry = json.at("methods").at(method);
    EXPECT_EQ(entry.at("queries"), 12);
    ASSERT_EQ(entry.at("rows").size(), 2U);
    EXPECT_EQ(entry.at("rows").at(1).at("value"), 0.1);
    EXPECT_EQ(entry.at("rows").at(1).at("queries"), 6);
    EXPECT_TRUE(entry.at("rows").at(1).contains("recall_at_1_interval"));
  }
  for (const char* picture :
       {"recall.png", "confident_right.png", "confidently_wrong.png", "time_ratio.png"})
  {
    EXPECT_EQ(readBytes(folder / picture).compare(1, 3, "PNG"), 0) << picture;
    EXPECT_NE(readBytes(folder / "report.md").find(picture), std::string::npos) << picture;
  }
}

TEST(Sweep, EveryQuantityRunsAtItsOwnValues)
{
  for (const SweptQuantity& quantity : sweptQuantities())
  {
    SweepOptions options =
        smallSweep(quantity.name, {quantity.values.front(), quantity.values.back()});
    options.worlds = {quantity.worlds.front()};
    options.queries_per_world = 2;
    const SweepReport report = runSweep(options);
    ASSERT_EQ(report.rows.size(), 2U) << quantity.name;
    // The laser sees the far end differently from the near one.
    const auto& near = report.rows[0].records[0].answer;
    const auto& far = report.rows[1].records[0].answer;
    EXPECT_TRUE(near.valid_beams != far.valid_beams || near.first_score != far.first_score)
        << quantity.name;
  }
}

TEST(Sweep, KeepsTheAngleBetweenBeams)
{
  SweepConditions narrow;
  SweepConditions full;
  sweptQuantity("fov").set(90, narrow);
  sweptQuantity("fov").set(360, full);
  EXPECT_EQ(narrow.laser.beams, 121U);
  EXPECT_EQ(full.laser.beams, 480U);
}

TEST(Sweep, RobotsOnThresholdsStandInDoorsAndSeeTheFloor)
{
  SweepOptions options = smallSweep("thresholds", {0, 0.05});
  options.queries_per_world = 8;
  const SweepReport report = runSweep(options);
  ASSERT_EQ(report.rows.size(), 2U);
  for (std::size_t i = 0; i < 8; ++i)
  {
    EXPECT_EQ(report.rows[0].records[i].answer.truth, report.rows[1].records[i].answer.truth);
  }
  options.worlds = {WorldKind::hall};
  EXPECT_THROW(runSweep(options), std::invalid_argument) << "no doors in it";
}

TEST(Sweep, RefusesWhatMakesNoSense)
{
  EXPECT_THROW(runSweep(smallSweep("weather", {1})), std::invalid_argument);
  EXPECT_THROW(runSweep(smallSweep("clutter", {1.5})), std::invalid_argument);
  EXPECT_THROW(runSweep(smallSweep("map-noise", {-0.1})), std::invalid_argument);
  SweepOptions options = smallSweep("noise", {});
  options.methods = {"guessing"};
  EXPECT_THROW(runSweep(options), std::invalid_argument);
  options = smallSweep("noise", {});
  options.worlds_per_kind = 0;
  EXPECT_THROW(runSweep(options), std::invalid_argument);
}
}  // namespace
}  // namespace sigloc
