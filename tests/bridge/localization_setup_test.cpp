// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/localize/LocalizationSetup.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bridge/rawlog_files.h"
#include "sigloc/io/file_output.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

LocalizationSetup read(const TemporaryFolder& folder, const std::string& more)
{
  writeText(folder / "a.map", "m");
  writeText(folder / "a.rawlog", "r");
  writeText(folder / "run.ini",
            "[LocalizationExperiment]\nmap_file=a.map\nrawlog_file=a.rawlog\n" + more);
  return readLocalizationSetup(folder / "run.ini");
}

TEST(LocalizationSetup, findsFilesBesideTheIni)
{
  const TemporaryFolder folder;
  const LocalizationSetup setup = read(folder, "");
  EXPECT_EQ(setup.map_file, folder / "a.map");
  EXPECT_EQ(setup.rawlog_file, folder / "a.rawlog");
  EXPECT_TRUE(setup.ground_truth_file.empty());
  EXPECT_TRUE(setup.output_folder.empty());
  EXPECT_FALSE(setup.prior);
  EXPECT_EQ(setup.repetitions, 1U);
}

TEST(LocalizationSetup, readsTheKeysOfPfLocalization)
{
  const TemporaryFolder folder;
  const LocalizationSetup setup =
      read(folder,
           "rawlog_offset=3\nlogOutput_dir=LOG // comment\n3DSceneFrequency=5\n"
           "experimentRepetitions=2\nparticles_count=100 200\ninit_PDF_mode=1\n"
           "init_PDF_min_x=-1\ninit_PDF_max_x=2\ninit_PDF_min_y=-3\ninit_PDF_max_y=4\n"
           "init_PDF_min_yaw_deg=0\ninit_PDF_max_yaw_deg=90\n[MetricMap]\nfoo=bar\n");
  EXPECT_EQ(setup.rawlog_offset, 3U);
  EXPECT_EQ(setup.output_folder, "LOG");
  EXPECT_EQ(setup.scene_frequency, 5U);
  EXPECT_EQ(setup.repetitions, 2U);
  ASSERT_TRUE(setup.prior);
  EXPECT_EQ(setup.prior->x_min, -1);
  EXPECT_EQ(setup.prior->y_max, 4);
  EXPECT_NEAR(setup.prior->heading, M_PI / 4, 1e-9);
  EXPECT_NEAR(setup.prior->heading_tolerance, M_PI / 4, 1e-9);
}

TEST(LocalizationSetup, readsWhatPfLocalizationJudgesBy)
{
  const TemporaryFolder folder;
  EXPECT_FALSE(read(folder, "").convergence_test_step);
  EXPECT_FALSE(read(folder, "experimentTestConvergenceAtStep=-1\n").convergence_test_step);
  const auto setup = read(folder,
                          "experimentTestConvergenceAtStep=7\nSTATS_CONF_INTERVAL=0.1\n"
                          "initial_odo_x=1\ninitial_odo_phi=0.5\ntracker=particles\n"
                          "particles_count=100 200\n");
  EXPECT_EQ(setup.convergence_test_step, 7U);
  EXPECT_EQ(setup.confidence_share, 0.1);
  EXPECT_EQ(setup.initial_odometry.x, 1);
  EXPECT_EQ(setup.initial_odometry.phi, 0.5);
  EXPECT_EQ(setup.particle_counts, (std::vector<std::uint32_t>{100, 200}));
}

TEST(LocalizationSetup, hostileSettingsAreRefusedInAShortLine)
{
  const TemporaryFolder folder;
  const std::string nines(900000, '9');
  for (const std::string& more :
       {"STATS_CONF_INTERVAL=" + nines + "\n", "[sigloc.matcher]\nmode=" + nines + "\n",
        "tracker=" + nines + "\n", std::string(std::size_t{1} << 20U, '\n'),
        std::string("[sigloc.reading]\nmin_height=2\nmax_height=1\n")})
  {
    const std::string message = messageOf<std::runtime_error>([&] { read(folder, more); });
    EXPECT_EQ(message.rfind((folder / "run.ini").string() + ": ", 0), 0U) << message.substr(0, 200);
    EXPECT_LT(message.size(), 1100U);
  }
}

TEST(LocalizationSetup, widensABoxThatIsAPose)
{
  const TemporaryFolder folder;
  const auto setup = read(folder,
                          "init_PDF_min_x=3\ninit_PDF_max_x=3\ninit_PDF_min_y=0\ninit_PDF_max_y=9\n"
                          "init_PDF_min_yaw_deg=170\ninit_PDF_max_yaw_deg=-170\n");
  ASSERT_TRUE(setup.prior);
  EXPECT_EQ(setup.prior->x_min, 2.5);
  EXPECT_EQ(setup.prior->x_max, 3.5);
  EXPECT_EQ(setup.prior->y_max, 9);
  EXPECT_NEAR(std::abs(setup.prior->heading), M_PI, 1e-9) << "across the turn of the heading";
  EXPECT_NEAR(setup.prior->heading_tolerance, M_PI / 18, 1e-9);
}

TEST(LocalizationSetup, choosesTheTracker)
{
  const TemporaryFolder folder;
  EXPECT_FALSE(read(folder, "").use_particles);
  EXPECT_FALSE(read(folder, "tracker = gaussians\n").use_particles);
  const auto setup = read(folder, "tracker = particles\n[sigloc.particles]\nparticles = 70\n");
  EXPECT_TRUE(setup.use_particles);
  EXPECT_EQ(setup.particles.particles, 70U);
}

TEST(LocalizationSetup, namesTheIniAndTheReason)
{
  const TemporaryFolder folder;
  const auto reason = [&](const std::string& more)
  { return messageOf<std::runtime_error>([&] { read(folder, more); }); };
  EXPECT_NE(reason("rawlog_offset=few\n").find("run.ini: [LocalizationExperiment]: bad value"),
            std::string::npos);
  EXPECT_NE(reason("rawlog_offset=-1\n").find("rawlog_offset"), std::string::npos);
  EXPECT_NE(reason("ground_truth_path_file=gone.txt\n").find("gone.txt"), std::string::npos);
  EXPECT_NE(reason("init_PDF_min_x=3\ninit_PDF_max_x=2\n").find("ends before it begins"),
            std::string::npos);
  EXPECT_NE(reason("tracker=particles\nparticles_count=many\n").find("'many'"), std::string::npos);
  EXPECT_NE(reason("tracker=particles\nparticles_count=100 11000000\n")
                .find("run.ini: [LocalizationExperiment]: bad value '11000000' for "
                      "'particles_count': from 1 to 10000000"),
            std::string::npos);
  EXPECT_NE(reason("STATS_CONF_INTERVAL=2\n").find("between 0 and 1"), std::string::npos);
  EXPECT_NE(reason("tracker=kalman\n").find("neither gaussians nor particles"), std::string::npos);
  EXPECT_NE(reason("[sigloc.matcher]\nmode=9\n").find("mode"), std::string::npos);
}

/// Lines of an ini that nobody writes in good faith, or by a slip, and what the refusal says of
/// them.
struct HostileIni
{
  std::string lines;
  std::string reason;
};

std::vector<HostileIni> hostileInis()
{
  const std::string far(400, '9');
  return {
      {"rawlog_offset = 0x10\n", "rawlog_offset"},
      {"rawlog_offset = 4294967296\n", "rawlog_offset"},
      {"rawlog_offset = " + far + "\n", "rawlog_offset"},
      {"experimentRepetitions = -1\n", "experimentRepetitions"},
      {"experimentRepetitions = 1000001\n", "experimentRepetitions"},
      {"STATS_CONF_INTERVAL = nan\n", "STATS_CONF_INTERVAL"},
      {"STATS_CONF_INTERVAL = 0,2\n", "STATS_CONF_INTERVAL"},
      {"initial_odo_x = inf\n", "initial_odo_x"},
      {"initial_odo_phi = 1e400\n", "initial_odo_phi"},
      {"init_PDF_min_x = nan\ninit_PDF_max_x = 2\n", "init_PDF_min_x"},
      {"init_PDF_min_x = -1e300\ninit_PDF_max_x = 1e300\n", "init_PDF_min_x"},
      {"tracker = particles\nparticles_count = -5\n", "particles_count"},
      {"tracker = particles\nparticles_count = 1e9\n", "particles_count"},
      {"tracker = particles\nparticles_count = 100 nan\n", "particles_count"},
      {"SAVE_STATS_ONLY = perhaps\n", "SAVE_STATS_ONLY"},
      {"[sigloc.matcher]\nmode = 5.5\n", "mode"},
      {"[sigloc.matcher]\nmax_candidates = 0\n", "max_candidates"},
      {"[sigloc.matcher]\nmax_candidates = 4294967297\n", "max_candidates"},
      {"[sigloc.matcher]\nseed = -1\n", "seed"},
      {"[sigloc.features]\nmin_range = nan\n", "min_range"},
      {"[sigloc.features]\nbreak_factor = inf\n", "break_factor"},
      {"[sigloc.map]\nraster_resolution = 0\n", "raster_resolution"},
      {"[sigloc.map]\nraster_resolution = 1e-300\n", "raster_resolution"},
      {"[sigloc.particles]\nparticles = 4000000000\n", "particles"},
      {"[sigloc.localize]\nmap_from_truth_x = 1e300\n", "map_from_truth_x"},
      {"[sigloc.localize]\npictures = 7\n", "pictures"},
      {"[sigloc.matcher]\nmod = 5\n", "mod"},
      {"[sigloc.match]\nmode = 5\n", "sigloc.match"},
      {"[sigloc.tracker]\ntracker = particles\n",
       "section sigloc.tracker: 'tracker' belongs in [LocalizationExperiment]"},
  };
}

TEST(LocalizationSetup, refusesWhatNobodyWritesInGoodFaith)
{
  for (const HostileIni& ini : hostileInis())
  {
    const TemporaryFolder folder;
    const std::string reason = messageOf<std::runtime_error>([&] { read(folder, ini.lines); });
    EXPECT_EQ(reason.rfind((folder / "run.ini").string() + ": ", 0), 0U)
        << ini.lines << "is answered by '" << reason << "'";
    EXPECT_NE(reason.find(ini.reason), std::string::npos) << ini.lines << reason;
    EXPECT_EQ(reason.find('\n'), std::string::npos) << reason;
  }
}

TEST(LocalizationSetup, warnsOfKeysThatNothingReads)
{
  const TemporaryFolder folder;
  EXPECT_TRUE(read(folder, "use_3D_poses=false\n# trackr=1\n[other]\ntrackr=1\ntrackr=2\n")
                  .warnings.empty());
  const auto warnings =
      read(folder, "colour = red\ntrackr = particles\nlogOutput_Dir2=x\nsmell=y\n").warnings;
  const std::string start = "[LocalizationExperiment]: nothing reads ";
  EXPECT_EQ(warnings, (std::vector<std::string>{
                          start + "'logOutput_Dir2'; did you mean 'logOutput_dir'?",
                          start + "'trackr'; did you mean 'tracker'?",
                          start + "'colour', 'smell'",
                      }));
  const char* const stock = "/usr/share/mrpt/config_files/pf-localization/localization_demo.ini";
  const auto ignored = readLocalizationSetup(stock).warnings;
  ASSERT_EQ(ignored.size(), 1U) << "what pf-localization does and sigloc does not";
  for (const char* key : {"SHOW_PROGRESS_3D_REAL_TIME", "particles_count", "[KLD_options]"})
  {
    EXPECT_NE(ignored[0].find(key), std::string::npos) << ignored[0];
  }
}

TEST(LocalizationSetup, takesUpperAndLowerCaseAlikeWithoutAWarning)
{
  const TemporaryFolder folder;
  const auto setup = read(folder, "logoutput_dir = x\nTracker = particles\n");
  EXPECT_EQ(setup.output_folder, "x");
  EXPECT_TRUE(setup.use_particles);
  EXPECT_TRUE(setup.warnings.empty());
}

TEST(LocalizationSetup, namesTheKeyThatIsMeantByAMisspeltOne)
{
  const TemporaryFolder folder;
  const auto reasonOf = [&](const std::string& ini)
  {
    writeText(folder / "run.ini", ini);
    const std::string reason =
        messageOf<std::runtime_error>([&] { readLocalizationSetup(folder / "run.ini"); });
    return reason.substr(reason.find(": ") + 2);
  };
  writeText(folder / "a.map", "m");
  EXPECT_EQ(reasonOf("[LocalizationExperiment]\nmap_fiel = a.map\nrawlog_file = a.rawlog\n"),
            "'map_file' is missing; did you mean it by 'map_fiel'?");
  EXPECT_EQ(reasonOf("[LocalizationExperiment]\nmap_file = a.map\nrawlogfile = a.rawlog\n"),
            "'rawlog_file' is missing; did you mean it by 'rawlogfile'?");
  EXPECT_EQ(reasonOf("[LocalizationExperiment]\nmap_file = a.map\n"), "'rawlog_file' is missing");
  EXPECT_EQ(reasonOf("[LocalisationExperiment]\nmap_file = a.map\n"),
            "no section [LocalizationExperiment]; did you mean it by 'LocalisationExperiment'?");
  EXPECT_EQ(reasonOf("[sigloc.traker]\n"),
            "unknown section [sigloc.traker]; did you mean 'sigloc.tracker'?");
}

TEST(LocalizationSetup, warnsOfKeysThatAreThereTwice)
{
  const TemporaryFolder folder;
  const auto setup = read(folder,
                          "rawlog_offset=3\n  rawlog_offset = 4\n"
                          "[sigloc.matcher]\nseed=5\n; seed=6\nseed=7\n[sigloc.tracker]\n");
  EXPECT_EQ(setup.rawlog_offset, 4U);
  EXPECT_EQ(setup.matcher.seed, 7U);
  ASSERT_EQ(setup.warnings.size(), 2U);
  EXPECT_NE(setup.warnings[0].find("'rawlog_offset' is there 2 times"), std::string::npos);
  EXPECT_NE(setup.warnings[1].find("[sigloc.matcher]: 'seed'"), std::string::npos);
}

TEST(LocalizationSetup, warnsOfLinesWithoutAKey)
{
  const TemporaryFolder folder;
  const auto setup = read(folder, "[sigloc.matcher]\nseed 5\n// a note\n[elsewhere]\nseed 6\n");
  ASSERT_EQ(setup.warnings.size(), 1U);
  EXPECT_NE(setup.warnings[0].find("is no `key = value`, and is not read"), std::string::npos);
}

TEST(LocalizationSetup, messagesAreOneLineWithoutMrptsTrimmings)
{
  EXPECT_EQ(oneLine("==== MRPT exception ====\nMessage:  It broke\nLocation: x.cpp:1\n"),
            "It broke");
  EXPECT_EQ(oneLine("==== MRPT exception ====\nIt broke\nCall stack:\n"), "It broke");
  EXPECT_EQ(oneLine("plain"), "plain");
  EXPECT_EQ(oneLine("two\nlines\n"), "two?lines");
  EXPECT_EQ(oneLine("\x1B[2J\x7F\tgr\xC3\xBC\xC3\x9F"), "?[2J??gr\xC3\xBC\xC3\x9F");
  EXPECT_EQ(oneLine(""), "");
}
}  // namespace
}  // namespace sigloc
