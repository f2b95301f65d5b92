// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A host program may set a locale that writes numbers differently: our files do not change.
#include <gtest/gtest.h>

#include <algorithm>

#include "rawlog_files.h"
#include "sigloc/io/map_files.h"
#include "sigloc/localize/RunWriter.h"
#include "support/host_locale.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using test::HostLocale;
using test::readBytes;
using test::TemporaryFolder;

void localize(const fs::path& ini, const fs::path& out, const fs::path& cache)
{
  LocalizationSetup setup = readLocalizationSetup(ini);
  RunWriter writer(out, setup.inputFiles());
  LocalizationRun run(setup, cache);
  while (const StepRecord* const step = run.next()) writer.writeBelief(*step, run.anywhere());
  writer.finish(run);
}

TEST(Locale, doesNotChangeWhatARunWrites)
{
  const TemporaryFolder folder;
  const fs::path ini = folder / "run.ini";
  test::writeText(ini, "[LocalizationExperiment]\nmap_file = " + test::kLabMap.string() +
                           "\nrawlog_file = " + test::kLabLog.string() +
                           "\n3DSceneFrequency = 20\nSTATS_CONF_INTERVAL = 0.25\n");
  const fs::path cache = folder / "cache.sigmap";
  localize(ini, folder / "plain", cache);
  const std::string map = readBytes(cache);
  fs::remove(cache);
  {
    const HostLocale host;
    localize(ini, folder / "host", cache);
  }
  EXPECT_TRUE(readBytes(cache) == map);
  for (const char* const file :
       {"path.tum", "cov_est.txt", "odo_est.txt", "PF_stats.txt", "belief/step_00009.txt",
        "belief/step_00009.CPosePDFSOG", "particles/particles_00001.txt", "annotated.rawlog"})
  {
    EXPECT_FALSE(readBytes(folder / "plain" / file).empty()) << file;
    EXPECT_TRUE(readBytes(folder / "plain" / file) == readBytes(folder / "host" / file)) << file;
  }
  // Times differ between two runs, but not the number of cells.
  const std::string steps = readBytes(folder / "host/steps.csv");
  const auto commas = [](const std::string& text)
  { return std::count(text.begin(), text.end(), ','); };
  EXPECT_EQ(commas(steps), commas(readBytes(folder / "plain/steps.csv")));
}
}  // namespace
}  // namespace sigloc
