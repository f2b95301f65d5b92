// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "config/columns.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

enum class Colour : std::uint8_t
{
  red,
  green
};

const char* toString(Colour colour)
{
  const bool is_known = colour == Colour::red || colour == Colour::green;
  return !is_known ? "unknown" : (colour == Colour::red ? "red" : "green");
}

struct Sample
{
  std::string name;
  double length = 0;
  std::size_t count = 0;
  bool good = false;
  Colour colour = Colour::red;
  std::optional<bool> checked;
  std::optional<TPose2D> pose;
};

double area(const Sample& sample)
{
  return sample.length * sample.length;
}

const Columns<Sample>& columnsOfSample()
{
  using C = Column<Sample>;
  static const Columns<Sample> columns = {
      C("name", &Sample::name, "", 0, {"who"}),
      C("length_m", &Sample::length, "from end to end", 2, {"length"}, 1),
      C("count", &Sample::count, "how many", 0, {"n"}),
      C("good", &Sample::good),
      C("colour", &Sample::colour),
      C("checked", &Sample::checked),
      C("x,y,phi", &Sample::pose, "", 1),
      C("area_m2", area, "", 3, {}, 0, Files::json),
      C(
          "twice", [](const Sample& s) { return 2 * s.count; }, "", 0, {}, 0, Files::csv),
      C("", area, "length squared", 1, {"area"})};
  return columns;
}

Sample sample()
{
  return {"a", 1.5, 3, true, Colour::green, false, TPose2D(1, 2, 0.5)};
}

TEST(Columns, AnObjectHasTheNamesInOrderAndAllDigits)
{
  Sample third = sample();
  third.length = 1.0 / 3;
  EXPECT_EQ(toJson(columnsOfSample(), third).dump(),
            R"({"name":"a","length_m":0.3333333333333333,"count":3,"good":true,"colour":"green",)"
            R"("checked":false,"x,y,phi":[1.0,2.0,0.5],"area_m2":0.1111111111111111})");
}

TEST(Columns, WhatIsMissingIsNullOrAnEmptyCell)
{
  Sample missing;
  missing.length = std::numeric_limits<double>::quiet_NaN();
  const auto json = toJson(columnsOfSample(), missing);
  EXPECT_TRUE(json.at("checked").is_null());
  EXPECT_EQ(nlohmann::ordered_json::parse(json.dump()).at("length_m"), nullptr);
  EXPECT_EQ(csvRow(columnsOfSample(), missing), ",,0,0,red,,,,,0");
}

TEST(Columns, AFileHasAHeadAndARowARecord)
{
  EXPECT_EQ(csvFile(columnsOfSample(), std::vector<Sample>{sample()}),
            "name,length_m,count,good,colour,checked,x,y,phi,twice\n"
            "a,1.50,3,1,green,0,1.0,2.0,0.50,6\n");
}

TEST(Columns, ATableIsOrderedBySection)
{
  const std::vector<Cells> rows = table(columnsOfSample(), std::vector<Sample>{sample()});
  EXPECT_EQ(rows.at(0), Cells({"who", "n", "area", "length"}));
  EXPECT_EQ(rows.at(1), Cells({"a", "3", "2.2", "1.50"}));
}

TEST(Columns, TheLegendHasHeadsAndNames)
{
  EXPECT_EQ(
      legend("Columns", columnsOfSample()),
      "\n## Columns\n\n* **length**, `length_m`: from end to end\n* **n**, `count`: how many\n"
      "* **area**: length squared\n");
}

TEST(Columns, MembersAreReadBackFromTheirCells)
{
  const std::vector<Cells> cells = {
      {"a"}, {"1.50"}, {"3"}, {"1"}, {"green"}, {"0"}, {"1.0", "2.0", "0.50"}};
  Sample stored;
  for (std::size_t i = 0; i < cells.size(); ++i)
    EXPECT_TRUE(columnsOfSample()[i].store(stored, cells[i])) << columnsOfSample()[i].name;
  EXPECT_EQ(csvRow(columnsOfSample(), stored), csvRow(columnsOfSample(), sample()));
  EXPECT_FALSE(columnsOfSample()[7].store) << "what is computed has nowhere to go";
}

TEST(Columns, BadCellsAreRefused)
{
  Sample stored;
  EXPECT_FALSE(columnsOfSample()[1].store(stored, {"1.5 m"}));
  EXPECT_FALSE(columnsOfSample()[2].store(stored, {"-3"}));
  EXPECT_FALSE(columnsOfSample()[2].store(stored, {""}));
  EXPECT_FALSE(columnsOfSample()[4].store(stored, {"unknown"}));
  EXPECT_TRUE(columnsOfSample()[1].store(stored, {""})) << "no number";
  EXPECT_TRUE(std::isnan(stored.length));
  EXPECT_TRUE(columnsOfSample()[6].store(stored, {"", "", ""})) << "no pose";
  EXPECT_FALSE(stored.pose.has_value());
}

struct Derived : Sample
{
  int more = 7;
};

TEST(Columns, ARecordHasTheColumnsOfWhatItDerivesFrom)
{
  Columns<Derived> columns = {{"more", &Derived::more}};
  columns.emplace_back(columnsOfSample()[1]);
  EXPECT_EQ(csvRow(columns, Derived{sample(), 7}), "7,1.50");
}
}  // namespace
}  // namespace sigloc
