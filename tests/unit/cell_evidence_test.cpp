// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/evidence/CellEvidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/wall_ahead.h"

namespace sigloc
{
namespace
{
using test::wallAhead;

/// Every return explained by the same share. One that is not explained at all is off the map's
/// walls.
std::vector<ExplainedReturn> allExplained(const DenseScan& scan, float share)
{
  return std::vector<ExplainedReturn>(scan.size(), {share, false, share <= 0});
}

TEST(ObservedCells, HasEveryCellOnceAndNoneForWhatIsIsolated)
{
  const DenseScan scan = wallAhead(4);
  for (const double heading : {0.0, 0.5 * M_PI, M_PI})
  {
    const ObservedCells view = observedCells(scan, {7, -3, heading});
    ASSERT_EQ(view.cell_of.size(), scan.size());
    EXPECT_EQ(view.cell_of.back(), ObservedCells::kNowhere);
    for (std::size_t i = 0; i + 1 < scan.size(); ++i) EXPECT_LT(view.cell_of[i], view.cells.size());
    for (std::size_t k = 1; k < view.cells.size(); ++k)
    {
      EXPECT_LT(view.cells[k - 1], view.cells[k]);
    }
  }
  EXPECT_EQ(observedCells(scan, {0, 0, 0}).cells.size(), 4U);
}

TEST(ObservedCells, HoldsWhatIsFartherThanAnyRobotDrives)
{
  const DenseScan scan = wallAhead(4);
  EXPECT_FALSE(observedCells(scan, {1e200, -1e200, 0}).cells.empty());
}

TEST(CellEvidence, CountsEachThingOnceHoweverOftenItIsSeen)
{
  const DenseScan scan = wallAhead(4);
  const ObservedCells view = observedCells(scan, {0, 0, 0});
  CellEvidence structure;
  EXPECT_NEAR(structure.addScan(view, allExplained(scan, 0.25F), 0), 4 * 0.75, 1e-6);
  for (int k = 1; k < 50; ++k)
  {
    EXPECT_NEAR(structure.addScan(view, allExplained(scan, 0.25F), 0.1 * k), 0, 1e-6);
  }
}

TEST(CellEvidence, ABetterLookTakesBackAndFewReturnsTellLittle)
{
  const DenseScan scan = wallAhead(4);
  const ObservedCells view = observedCells(scan, {0, 0, 0});
  CellEvidence structure;
  const double first = structure.addScan(view, allExplained(scan, 0), 0);
  EXPECT_NEAR(first, 4, 1e-6);
  EXPECT_NEAR(structure.addScan(view, allExplained(scan, 1), 1), -2, 1e-6);

  DenseScan single = wallAhead(1);
  for (auto* column : {&single.x, &single.y}) column->erase(column->begin(), column->begin() + 2);
  single.isolated.erase(single.isolated.begin(), single.isolated.begin() + 2);
  CellEvidence other;
  EXPECT_NEAR(other.addScan(observedCells(single, {0, 0, 0}), allExplained(single, 0), 0),
              1.0 / 3.0, 1e-6);
}

TEST(CellEvidence, WhatWasSeenLongAgoIsNewsAgain)
{
  const DenseScan scan = wallAhead(4);
  const ObservedCells view = observedCells(scan, {0, 0, 0});
  for (const double start : {0.0, 100.0, -30.0})
  {
    CellEvidence structure;
    EXPECT_NEAR(structure.addScan(view, allExplained(scan, 0.5F), start), 2, 1e-6);
    EXPECT_NEAR(structure.addScan(view, allExplained(scan, 0.5F), start + 9.9), 0, 1e-6);
    EXPECT_NEAR(structure.addScan(view, allExplained(scan, 0.5F), start + 20.1), 2, 1e-6);
  }
}

TEST(CellEvidence, TellsTheShareOfAllItHasSeen)
{
  const DenseScan scan = wallAhead(10);
  const std::vector<ExplainedReturn> on_walls = allExplained(scan, 1);
  const std::vector<ExplainedReturn> off_walls = allExplained(scan, 0);
  CellEvidence structure;
  EXPECT_EQ(structure.offWallShare(), 0);
  structure.addScan(observedCells(scan, {0, 0, 0}), on_walls, 0);
  EXPECT_NEAR(structure.offWallShare(), 0, 1e-6);
  structure.addScan(observedCells(scan, {50, 0, 0}), off_walls, 5);
  EXPECT_NEAR(structure.offWallShare(), 0.5, 1e-6);
  structure.addScan(observedCells(scan, {50, 0, 0}), off_walls, 6);
  EXPECT_NEAR(structure.offWallShare(), 0.5, 1e-6) << "seen before";
  structure.addScan(observedCells(scan, {50, 0, 0}), off_walls, 30);
  EXPECT_NEAR(structure.unexplained(), 20, 1e-6) << "what was long ago is news again, ...";
  EXPECT_NEAR(structure.offWallShare(), 20.0 / 30.0, 1e-6) << "and what was seen then still counts";
}

TEST(CellEvidence, UnknownAreaIsOffNoWall)
{
  const DenseScan scan = wallAhead(10);
  CellEvidence structure;
  structure.addScan(observedCells(scan, {0, 0, 0}), allExplained(scan, 1), 0);
  structure.addScan(observedCells(scan, {50, 0, 0}), allExplained(scan, 0), 5);
  const double before = structure.offWallShare();
  structure.addScan(observedCells(scan, {100, 0, 0}),
                    std::vector<ExplainedReturn>(scan.size(), {0, true, false}), 6);
  EXPECT_NEAR(structure.offWallShare(), before, 1e-9);
  EXPECT_NEAR(structure.known(), 20, 1e-6);
}

TEST(CellEvidence, OneCellOffAllWallsIsAll)
{
  const DenseScan scan = wallAhead(1);
  CellEvidence structure;
  structure.addScan(observedCells(scan, {0, 0, 0}), allExplained(scan, 0), 0);
  EXPECT_NEAR(structure.offWallShare(), 1.0, 1e-6);
}

TEST(CellEvidence, TheShareStaysOneWhenCountedAnew)
{
  // A cell that was seen before is not counted again when it is explained better or worse.
  const DenseScan scan = wallAhead(10);
  for (const float first : {0.0F, 1.0F})
  {
    CellEvidence structure;
    structure.addScan(observedCells(scan, {0, 0, 0}), allExplained(scan, first), 0);
    structure.countAnew();
    structure.addScan(observedCells(scan, {0.5, 0, 0}), allExplained(scan, 1 - first), 1);
    EXPECT_GE(structure.offWallShare(), 0);
    EXPECT_LE(structure.offWallShare(), 1);
  }
}
}  // namespace
}  // namespace sigloc
