// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// Every input in tests/corpus through its target: samples of good files, and whatever was once a
// finding.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/targets.h"

namespace sigloc::fuzz
{
namespace
{
std::string contentOf(const std::filesystem::path& path)
{
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class Corpus : public ::testing::TestWithParam<NamedTarget>
{
};

TEST_P(Corpus, IsReadOrRefusedInGoodOrder)
{
  const auto folder = std::filesystem::path(SIGLOC_CORPUS) / GetParam().name;
  std::size_t inputs = 0;
  std::size_t accepted = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    const std::string name = entry.path().filename().string();
    const bool sample = name.rfind("good", 0) == 0;
    ++inputs;
    try
    {
      const bool read = GetParam().run(contentOf(entry.path()));
      EXPECT_TRUE(read || !sample) << name << " is refused";
      accepted += read;
    }
    catch (const Finding& finding)
    {
      ADD_FAILURE() << name << ": " << finding.what();
    }
  }
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 1500000) << "[kB]";
  EXPECT_GT(inputs, 0U);
  EXPECT_GT(accepted, 0U) << "or the target tests nothing but the first bytes";
}

INSTANTIATE_TEST_SUITE_P(Of, Corpus, ::testing::ValuesIn(kTargets),
                         [](const auto& target) { return std::string(target.param.name); });
}  // namespace
}  // namespace sigloc::fuzz
