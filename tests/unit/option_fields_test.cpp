// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/config/option_fields.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <cstdint>
#include <limits>
#include <string>

namespace sigloc
{
namespace
{
using mrpt::config::CConfigFileMemory;

struct ExampleOptions
{
  double gate = 9.21;
  std::uint32_t count = 12;
  int offset = -1;
  bool dense = true;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = ExampleOptions;
    visit(OptionField{"gate", &O::gate, 0.0, 100.0, "[-] chi-square gate"});
    visit(OptionField{"count", &O::count, 1U, 50U, "[-] how many"});
    visit(OptionField{"offset", &O::offset, -10, 10, "[-] shift"});
    visit(OptionField{"dense", &O::dense, false, true, "[-] use the dense field"});
  }
};

ExampleOptions load(const std::string& section_text)
{
  return loadOptions<ExampleOptions>(CConfigFileMemory("[sigloc.example]\n" + section_text),
                                     "sigloc.example");
}

/// Returns what() of the std::invalid_argument that loading the section throws, or "".
std::string refusal(const std::string& section_text)
{
  try
  {
    load(section_text);
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "";
}

TEST(OptionFields, absentKeysKeepTheDefaultsAndPresentOnesAreRead)
{
  const ExampleOptions options = load("gate = 2.5e-1 // [-] a comment\ncount = 7\ndense = no\n");
  EXPECT_EQ(options.gate, 0.25);
  EXPECT_EQ(options.count, 7U);
  EXPECT_EQ(options.offset, -1);
  EXPECT_FALSE(options.dense);

  ExampleOptions defaults;
  defaults.offset = 4;
  EXPECT_EQ(loadOptions(CConfigFileMemory(""), "sigloc.example", defaults).offset, 4);
}

TEST(OptionFields, unknownKeyIsNamedWithItsSection)
{
  EXPECT_EQ(refusal("gaet = 3\n"),
            "section sigloc.example: unknown key 'gaet'; did you mean 'gate'?");
}

TEST(OptionFields, valuesThatAreNotOfTheFieldsTypeAreRefused)
{
  for (const char* line : {"gate = wide", "gate = 1.5 m", "count = 2.5", "count = -1",
                           "offset = ", "offset = 99999999999999", "dense = maybe", "dense = 2"})
  {
    const std::string key = std::string(line).substr(0, std::string(line).find(' '));
    const std::string message = refusal(line);
    EXPECT_NE(message.find("bad value"), std::string::npos) << line << ": " << message;
    EXPECT_NE(message.find("'" + key + "'"), std::string::npos) << line << ": " << message;
  }
}

TEST(OptionFields, refusalsSayWhatIsWanted)
{
  EXPECT_EQ(refusal("dense = off"),
            "section sigloc.example: bad value 'off' for 'dense', not true or false");
  EXPECT_EQ(refusal("gate = wide"),
            "section sigloc.example: bad value 'wide' for 'gate', not a number from 0 to 100");
  EXPECT_EQ(refusal("count = 2.5"),
            "section sigloc.example: bad value '2.5' for 'count', not a whole number from 1 to 50");
}

TEST(OptionFields, valuesOutsideTheirRangeAndNanAreRefused)
{
  EXPECT_EQ(refusal("gate = 100.5"), "option 'gate' = 100.5 is outside [0, 100]");
  EXPECT_EQ(refusal("count = 0"), "option 'count' = 0 is outside [1, 50]");
  EXPECT_NE(refusal("gate = nan"), "");
  EXPECT_NE(refusal("gate = inf"), "");
  EXPECT_EQ(refusal("gate = 100"), "") << "the range includes its ends";

  ExampleOptions options;
  EXPECT_NO_THROW(checkOptions(options));
  options.gate = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(checkOptions(options), std::invalid_argument);
}

TEST(OptionFields, savingAndLoadingGivesTheSameBits)
{
  ExampleOptions saved;
  saved.gate = 1.0 / 3.0;
  saved.count = 50;
  saved.offset = -10;
  saved.dense = false;
  CConfigFileMemory ini;
  saveOptions(saved, ini, "sigloc.example");
  const auto loaded = loadOptions<ExampleOptions>(ini, "sigloc.example");
  EXPECT_EQ(loaded.gate, saved.gate);
  EXPECT_EQ(loaded.count, saved.count);
  EXPECT_EQ(loaded.offset, saved.offset);
  EXPECT_EQ(loaded.dense, saved.dense);
  EXPECT_NE(ini.getContent().find("[-] chi-square gate"), std::string::npos)
      << "the description is saved as the comment";
}

TEST(OptionFields, keysComeInTableOrder)
{
  EXPECT_EQ(optionKeys<ExampleOptions>(),
            (std::vector<std::string>{"gate", "count", "offset", "dense"}));
}
}  // namespace
}  // namespace sigloc
