// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "command_line.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

const std::string kOfficeLog = (kSources / "rawlogs" / "office.rawlog").string();
const std::string kOfficeTruth = (kSources / "rawlogs" / "office-truth.txt").string();

/// A call that must fail with one line on stderr that contains `complaint`, and write nothing.
struct Refusal
{
  const char* name;
  Arguments arguments;
  const char* complaint;
};

class EvalOptions : public testing::TestWithParam<Refusal>
{
};

TEST_P(EvalOptions, AreRefusedInOneLine)
{
  const TemporaryFolder folder;
  writeText(folder / "file", "");
  const auto before = listing(folder);
  const auto result = run(folder, "sigloc-eval", GetParam().arguments);
  EXPECT_EQ(result.exit_code, 1) << result.output;
  EXPECT_EQ(countLines(result.errors), 1) << result.errors;
  EXPECT_NE(result.errors.find(GetParam().complaint), std::string::npos) << result.errors;
  EXPECT_EQ(listing(folder), before);
}

Arguments sweepOver(const std::string& quantity, const std::string& values)
{
  return {"sweep", "--over", quantity, "--values", values, "--out", "out"};
}

INSTANTIATE_TEST_SUITE_P(
    Bad, EvalOptions,
    testing::Values(
        Refusal{"WideView", sweepOver("fov", "4000"), "fov 4000: not from 10 to 360"},
        Refusal{"MoreThanAllClutter", sweepOver("clutter", "1.5"), "clutter 1.5: not from 0 to 1"},
        Refusal{"NegativeNoise", sweepOver("noise", "-0.1"), "noise -0.1: not from"},
        Refusal{"HalfACopy", sweepOver("repeats", "2.5"), "repeats 2.5: not a whole number"},
        Refusal{"ValueTwice", sweepOver("noise", "0.01,0.01"), "noise 0.01: given twice"},
        Refusal{"QueriesWithoutEnd",
                {"sweep", "--over", "noise", "--queries", "4294967295", "--out", "out"},
                "--queries: 4294967295: not a number from 1 to 1e+06"},
        Refusal{"NoQueries",
                {"sweep", "--over", "noise", "--max-queries", "0", "--out", "out"},
                "--max-queries: 0: not a number from 1"},
        Refusal{"NegativePictures",
                {"sweep", "--over", "noise", "--draw-failures", "-1", "--out", "out"},
                "--draw-failures"},
        Refusal{"RegionOfManyWorlds",
                {"sweep", "--over", "noise", "--region", "0,1,0,1", "--out", "out"},
                "takes no --region"},
        Refusal{"RegionThatIsNoNumber",
                {"relocate", "--map", kOffice.string(), "--queries", kOffice.string(), "--region",
                 "nan,1,0,1", "--out", "out"},
                "--region"},
        Refusal{"NegativeHeadingTolerance",
                {"relocate", "--map", kOffice.string(), "--queries", kOffice.string(), "--heading",
                 "0,-3", "--out", "out"},
                "--heading"},
        Refusal{"RegionForReliability",
                {"reliability", "--region", "0,1,0,1", "--out", "out"},
                "--region"},
        Refusal{"MethodForReliability",
                {"reliability", "--method", "signature", "--out", "out"},
                "--method"},
        Refusal{"RegionForScale",
                {"scale", "--region", "0,1,0,1", "--out", "out"},
                "takes no --region"},
        Refusal{"DensityThatIsNoNumber",
                {"scale", "--density", "nan", "--out", "out"},
                "--density: nan: not a number from"},
        Refusal{"DensityOfAPile",
                {"scale", "--density", "1e9", "--out", "out"},
                "--density: 1e9: not a number from 0.001 to 100"},
        Refusal{"SpuriousShareThatIsNoNumber",
                {"scale", "--spurious", "nan", "--out", "out"},
                "--spurious: nan"},
        Refusal{"RangeThatIsNoNumber", {"scale", "--range", "nan", "--out", "out"}, "--range: nan"},
        Refusal{"NegativeMapFeatures",
                {"scale", "--map-features", "-1", "--out", "out"},
                "--map-features: -1: not a number from 1"},
        Refusal{"NoParticles",
                {"track", "--simulate", "1", "--method", "mcl", "--particles", "0", "--out", "out"},
                "--particles: 0: not a number from 1"},
        Refusal{"EndlessTravel",
                {"track", "--simulate", "1", "--travel", "1e30", "--out", "out"},
                "--travel: 1e30"},
        Refusal{"MapErrorWithoutEnd",
                {"track", "--simulate", "1", "--map-sigma", "inf", "--out", "out"},
                "--map-sigma: inf"},
        Refusal{"FrameThatIsNoNumber",
                {"relocate", "--map", kOffice.string(), "--queries", kOffice.string(),
                 "--map-from-queries", "nan,0,0", "--out", "out"},
                "--map-from-queries: nan"},
        Refusal{"MoreStartsThanPlaces",
                {"track", "--map", kOffice.string(), "--rawlog", kOfficeLog, "--ground-truth",
                 kOfficeTruth, "--starts", "100000", "--travel", "5", "--out", "out"},
                "places with 5.0 m of drive after it"},
        Refusal{"FilterInARegionOfWall",
                {"track", "--map", kOffice.string(), "--rawlog", kOfficeLog, "--ground-truth",
                 kOfficeTruth, "--starts", "1", "--travel", "1", "--method", "mcl", "--region",
                 "-1,-1,-1,-1", "--out", "out"},
                "no free place inside the region"},
        Refusal{"StartsOfASimulation",
                {"track", "--simulate", "2", "--starts", "3", "--out", "out"},
                "--starts"},
        Refusal{"NegativeTravel",
                {"track", "--landmarks", "dlr", "--landmark-folder", ".", "--travel", "-5", "--out",
                 "out"},
                "--travel: -5: not a number from 0"},
        Refusal{"LandmarksOfASimulation",
                {"track", "--landmarks", "dlr", "--landmark-folder", ".", "--simulate", "2",
                 "--out", "out"},
                "--landmarks"},
        Refusal{
            "MapOfALandmarkLog",
            {"track", "--landmarks", "dlr", "--landmark-folder", ".", "--map", "x", "--out", "out"},
            "--map"},
        Refusal{"ParticlesOfNoFilter",
                {"track", "--simulate", "1", "--method", "signature", "--particles", "9", "--out",
                 "out"},
                "--particles: no particle filter"},
        Refusal{"ParticlesForLandmarks",
                {"track", "--landmarks", "dlr", "--landmark-folder", ".", "--particles", "9",
                 "--out", "out"},
                "--particles: no particle filter"},
        Refusal{
            "TemperingOfNoFilter",
            {"track", "--simulate", "1", "--method", "mcl", "--tempering", "0.5", "--out", "out"},
            "--tempering: mcl-best is not to be run"},
        Refusal{"SimulatedAndRecordedScans",
                {"relocate", "--map", kOffice.string(), "--scans-in-map", "3", "--interleave", "2",
                 "--out", "out"},
                "--scans-in-map asks no recorded scans"},
        Refusal{
            "DenseFieldOfLandmarks",
            {"track", "--landmarks", "dlr", "--landmark-folder", ".", "--no-dense", "--out", "out"},
            "--no-dense: maps of landmarks"},
        Refusal{"DenseFieldOfPoints",
                {"track", "--simulate", "1", "--worlds", "points", "--no-dense", "--out", "out"},
                "--no-dense: maps of landmarks"},
        Refusal{"DenseFieldOfOthers",
                {"relocate", "--map", kOffice.string(), "--interleave", "2", "--method",
                 "exhaustive", "--no-dense", "--out", "out"},
                "--no-dense: no signature method"},
        Refusal{"DenseFieldOfScale", {"scale", "--no-dense", "--out", "out"}, "--no-dense"},
        Refusal{"FurnitureOfPoints",
                {"track", "--simulate", "1", "--worlds", "points", "--moved-share", "0.5", "--out",
                 "out"},
                "--moved-share: has no use"},
        Refusal{
            "UnmappedInPoints",
            {"track", "--simulate", "1", "--worlds", "points", "--unmapped", "5", "--out", "out"},
            "--unmapped: has no use"},
        Refusal{"TruthOfAForeignLog",
                {"track", "--map", kOffice.string(), "--rawlog", kLabLog.string(), "--foreign",
                 "--ground-truth", "x", "--out", "out"},
                "--ground-truth"},
        Refusal{
            "ForeignLandmarks",
            {"track", "--landmarks", "dlr", "--landmark-folder", ".", "--foreign", "--out", "out"},
            "--foreign"},
        Refusal{"KidnappedAbroad",
                {"track", "--simulate", "1", "--foreign", "--kidnap", "--out", "out"},
                "nothing to notice"},
        Refusal{"TruthOfKeyFrames",
                {"relocate", "--map", kOffice.string(), "--queries", kOffice.string(),
                 "--ground-truth", "x", "--out", "out"},
                "--ground-truth needs --rawlog"},
        Refusal{"TruthOfForeignScans",
                {"relocate", "--map", kOffice.string(), "--rawlog", kLabLog.string(),
                 "--ground-truth", "x", "--foreign", "--out", "out"},
                "no truth is read"},
        Refusal{"FrameOfOwnScans",
                {"relocate", "--map", kOffice.string(), "--interleave", "2", "--map-from-queries",
                 "1,0,0", "--out", "out"},
                "--map-from-queries"},
        Refusal{"ForeignOwnScans",
                {"relocate", "--map", kOffice.string(), "--interleave", "2", "--foreign", "--out",
                 "out"},
                "--foreign"},
        Refusal{"LocalMapsOfThePark",
                {"landmarks", "--dataset", "victoria-park", ".", "--local-map-steps", "3", "--out",
                 "out"},
                "--local-map-steps: has no use"},
        Refusal{"TravelInDlr",
                {"landmarks", "--dataset", "dlr", ".", "--max-travel", "3", "--out", "out"},
                "--max-travel: has no use"},
        Refusal{
            "NoMapFeatures", {"scale", "--map-features", "0", "--out", "out"}, "--map-features"},
        Refusal{"MoreThanIsSeen",
                {"scale", "--map-features", "500", "--observed", "900", "--out", "out"},
                "--observed 900: not from 1 to"},
        Refusal{"ClutterOfALog", {"track", "--clutter", "0.3", "--out", "out"}, "--simulate"},
        Refusal{"UnknownRelocation",
                {"relocate", "--map", kOffice.string(), "--interleave", "2", "--method", "best",
                 "--out", "out"},
                "known are signature, signature-plain"},
        Refusal{"NoInterleave",
                {"relocate", "--map", kOffice.string(), "--interleave", "0", "--out", "out"},
                "--interleave: 0: not a number from 2"},
        Refusal{"UnknownTracking",
                {"track", "--simulate", "1", "--method", "best", "--out", "out"},
                "mcl-tuned, mcl-best, mcl-stock"},
        Refusal{"UnknownFeatureMethod",
                {"scale", "--method", "best", "--out", "out"},
                "jcbb-greedy, interpretation-tree, clique"},
        Refusal{"MethodTwice",
                {"track", "--simulate", "1", "--method", "mcl,mcl", "--out", "out"},
                "mcl: given twice"},
        // The folder is checked before the map is.
        Refusal{"FolderInAFile",
                {"relocate", "--map", "none.simplemap", "--interleave", "2", "--out", "file/out"},
                "file/out: "},
        Refusal{"FolderThatIsAFile", {"scale", "--out", "file"}, "is no folder"},
        Refusal{"TruthIntoAFolder",
                {"reference", "--map", kLabMap.string(), "--rawlog", kLabLog.string(), "--last",
                 "15.9,-10.01,4.9", "--out", "."},
                "is a folder"},
        Refusal{"LastPoseOffTheMap",
                {"reference", "--map", kLabMap.string(), "--rawlog", kLabLog.string(), "--last",
                 "500,500,0", "--out", "truth.txt"},
                "only 0 % of the scan"},
        Refusal{"LastPoseTurned",
                {"reference", "--map", kLabMap.string(), "--rawlog", kLabLog.string(), "--last",
                 "15.9,-10.01,94.9", "--out", "truth.txt"},
                "the last pose is wrong"}),
    [](const auto& refusal) { return std::string(refusal.param.name); });

TEST(EvalHelp, NamesTheMethods)
{
  const TemporaryFolder folder;
  const auto names = [&](const std::string& command, const std::string& method)
  {
    std::string help = run(folder, "sigloc-eval", {command, "--help"}).output;
    help.erase(std::remove(help.begin(), help.end(), '\n'), help.end());
    return help.find(method) != std::string::npos;
  };
  EXPECT_TRUE(names("relocate", "branch-and-bound"));
  EXPECT_TRUE(names("sweep", "lattice"));
  EXPECT_TRUE(names("track", "mcl-stock"));
  EXPECT_TRUE(names("scale", "interpretation-tree"));
  EXPECT_TRUE(names("landmarks", "jcbb"));
}

TEST(EvalReport, IsWrittenInWholeOrNotAtAll)
{
  const TemporaryFolder folder;
  const Arguments scale = {"scale", "--map-features", "300",   "--poses",
                           "1",     "--quiet",        "--out", "out"};
  ASSERT_EQ(run(folder, "sigloc-eval", scale).exit_code, 0);
  const auto before = listing(folder);
  const std::string report = readBytes(folder / "out" / "report.md");
  // No file may grow beyond a block, as on a disk that is full.
  const std::string command = "cd " + quoted(folder.path().string()) + " && ulimit -f 1 && " +
                              quoted(std::string(SIGLOC_BIN_FOLDER) + "/sigloc-eval") +
                              " scale --map-features 300,400 --poses 1 --quiet --out ";
  EXPECT_NE(std::system((command + "out 2>errors").c_str()), 0);
  EXPECT_NE(readBytes(folder / "errors").find("cannot be written"), std::string::npos)
      << readBytes(folder / "errors");
  std::filesystem::remove(folder / "errors");
  EXPECT_EQ(listing(folder), before);
  EXPECT_EQ(readBytes(folder / "out" / "report.md"), report);
  EXPECT_NE(std::system((command + "new/one 2>/dev/null").c_str()), 0);
  EXPECT_EQ(listing(folder), before) << "folders made on the way are gone";
}

TEST(EvalReport, NeedsNoPlots)
{
  // Without gnuplot, or when it fails, only the plots are missing.
  const TemporaryFolder folder;
  const std::string command = "cd " + quoted(folder.path().string()) + " && PATH=/nonexistent " +
                              quoted(std::string(SIGLOC_BIN_FOLDER) + "/sigloc-eval") +
                              " scale --map-features 300,400 --poses 1 --out out >table 2>errors";
  EXPECT_EQ(std::system(command.c_str()), 0) << readBytes(folder / "errors");
  EXPECT_NE(readBytes(folder / "table").find("| signature"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "report.md"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "time.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / ".part"));
}

TEST(EvalTrack, SimulatedParticleFiltersHaveTheNumberAskedFor)
{
  const TemporaryFolder folder;
  const auto results = [&](const std::string& particles)
  {
    const auto done = run(folder, "sigloc-eval",
                          {"track", "--simulate", "1", "--worlds", "office", "--travel", "1",
                           "--method", "mcl", "--particles", particles, "--quiet", "--out", "out"});
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    return readBytes(folder / "out" / "runs.csv") + readBytes(folder / "out" / "results.csv");
  };
  const auto poses = [](std::string csv)
  {
    // Without the last column, the time.
    std::string kept;
    for (std::size_t at = 0, end = 0; (end = csv.find('\n', at)) != std::string::npos; at = end + 1)
    {
      kept += csv.substr(at, csv.rfind(',', end) - at) + "\n";
    }
    return kept;
  };
  const std::string few = poses(results("300"));
  EXPECT_EQ(few, poses(results("300")));
  EXPECT_NE(few, poses(results("3000")));
}
}  // namespace
}  // namespace sigloc
