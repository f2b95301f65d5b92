// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/localize/LocalizationSetup.h"

#include <fmt/core.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "config/nearest_word.h"
#include "io/archive/file_fault.h"
#include "io/archive/gzip_input.h"
#include "io/carmen_log.h"
#include "io/maps/map_formats.h"
#include "io/reading_check.h"
#include "io/text_rows.h"
#include "localize/ini_warnings.h"
#include "sigloc/io/file_output.h"
#include "sigloc/io/map_files.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using mrpt::config::CConfigFileMemory;

constexpr const char* kExperiment = "LocalizationExperiment";
constexpr const char* kPrefix = "sigloc.";
constexpr const char* kMatcher = "sigloc.matcher";
constexpr const char* kTracker = "sigloc.tracker";
constexpr const char* kParticles = "sigloc.particles";
constexpr const char* kFeatures = "sigloc.features";
constexpr const char* kMap = "sigloc.map";
constexpr const char* kReading = "sigloc.reading";
constexpr const char* kReport = "sigloc.localize";
constexpr const char* kMapAndLog = "; for a map and a log: --map MAP --log LOG";
constexpr std::array<const char*, 7> kSections = {kMatcher, kTracker, kParticles, kFeatures,
                                                  kMap,     kReading, kReport};

/// Throws for a key of [LocalizationExperiment] in a section of ours, such as `tracker`.
void refuseExperimentKeys(const CConfigFileMemory& ini, const std::string& section)
{
  std::vector<std::string> keys;
  ini.getAllKeys(section, keys);
  for (const std::string& key : keys)
  {
    if (!detail::isExperimentKey(key)) continue;
    throw std::runtime_error(
        fmt::format("section {}: '{}' belongs in [{}]", section, key, kExperiment));
  }
}

void readSections(const CConfigFileMemory& ini, LocalizationSetup& setup)
{
  std::vector<std::string> sections;
  ini.getAllSections(sections);
  for (const std::string& section : sections)
  {
    const bool ours = section.rfind(kPrefix, 0) == 0;
    const bool known = std::find(kSections.begin(), kSections.end(), section) != kSections.end();
    if (ours && !known)
    {
      throw std::runtime_error("unknown section [" + section + "]" +
                               didYouMean(section, {kSections.begin(), kSections.end()}));
    }
    if (known) refuseExperimentKeys(ini, section);
  }
  setup.matcher = loadOptions<MatcherOptions>(ini, kMatcher);
  setup.tracker = loadOptions<TrackerOptions>(ini, kTracker);
  setup.particles = loadOptions<ParticleOptions>(ini, kParticles);
  setup.features = loadOptions<FeatureExtractorOptions>(ini, kFeatures);
  setup.map = loadOptions<MapBuildingOptions>(ini, kMap);
  setup.reading = loadOptions<ReadingOptions>(ini, kReading);
  detail::checkReading(setup.reading);
  setup.report = loadOptions<ReportOptions>(ini, kReport);
}

[[noreturn]] void failInExperiment(const std::string& reason)
{
  throw std::runtime_error(fmt::format("[{}]: {}", kExperiment, reason));
}

double readNumber(const CConfigFileMemory& ini, const char* key, double fallback)
{
  const std::string text = ini.read_string_first_word(kExperiment, key, "");
  if (text.empty()) return fallback;
  const std::optional<double> value = detail::toNumber(text);
  if (!value) failInExperiment(fmt::format("bad value {} for '{}'", detail::quoted(text), key));
  return *value;
}

bool readSwitch(const CConfigFileMemory& ini, const char* key)
{
  const std::string text = ini.read_string_first_word(kExperiment, key, "false");
  const std::optional<bool> value = detail::parseValue<bool>(text);
  if (!value) failInExperiment(fmt::format("bad value {} for '{}'", detail::quoted(text), key));
  return *value;
}

std::uint32_t readCount(const CConfigFileMemory& ini, const char* key, std::uint32_t fallback)
{
  const double value = readNumber(ini, key, fallback);
  if (value < 0 || value > 1e9 || value != std::floor(value))
  {
    failInExperiment(fmt::format("'{}' is not a count of at least 0", key));
  }
  return static_cast<std::uint32_t>(value);
}

/// A side [m] of the box in which the robot is. Farther out there is no map.
double readSide(const CConfigFileMemory& ini, const char* key)
{
  constexpr double kFarthest = 1e6;
  const double side = readNumber(ini, key, 0);
  if (std::abs(side) > kFarthest)
  {
    failInExperiment(fmt::format("'{}' is farther out than {:g} m", key, kFarthest));
  }
  return side;
}

/// The box in which pf-localization draws its particles, in either init_PDF_mode. One that is
/// narrower than the errors of a right pose is widened to these.
std::optional<PoseRegion> readPrior(const CConfigFileMemory& ini)
{
  constexpr AccuracyGates kGates;
  PoseRegion region{readSide(ini, "init_PDF_min_x"), readSide(ini, "init_PDF_max_x"),
                    readSide(ini, "init_PDF_min_y"), readSide(ini, "init_PDF_max_y")};
  if (region.x_min > region.x_max || region.y_min > region.y_max)
  {
    failInExperiment("the box init_PDF_* ends before it begins");
  }
  const bool has_box = region.x_min < region.x_max || region.y_min < region.y_max ||
                       ini.keyExists(kExperiment, "init_PDF_min_x");
  if (!has_box) return std::nullopt;
  const auto widen = [&](double& low, double& high)
  {
    const double missing = std::max(0.0, kGates.right_distance - 0.5 * (high - low));
    low -= missing;
    high += missing;
  };
  widen(region.x_min, region.x_max);
  widen(region.y_min, region.y_max);
  const double min_yaw = mrpt::DEG2RAD(readNumber(ini, "init_PDF_min_yaw_deg", -180));
  double max_yaw = mrpt::DEG2RAD(readNumber(ini, "init_PDF_max_yaw_deg", 180));
  if (max_yaw < min_yaw) max_yaw += 2 * M_PI;  // across the turn of the heading
  if (max_yaw - min_yaw < 2 * M_PI - 1e-6)
  {
    region.heading = mrpt::math::wrapToPi(0.5 * (min_yaw + max_yaw));
    region.heading_tolerance = std::max(kGates.right_angle, 0.5 * (max_yaw - min_yaw));
  }
  return region;
}

std::uint32_t readRepetitions(const CConfigFileMemory& ini)
{
  constexpr std::uint32_t kMost = 100000;
  const std::uint32_t count = readCount(ini, "experimentRepetitions", 1);
  if (count > kMost)
  {
    failInExperiment(fmt::format("'experimentRepetitions' is more than {}", kMost));
  }
  return std::max(1U, count);
}

/// Numbers of particles, one experiment each.
std::vector<std::uint32_t> readParticleCounts(const CConfigFileMemory& ini)
{
  std::vector<std::uint32_t> counts;
  std::istringstream words(ini.read_string(kExperiment, "particles_count", ""));
  for (std::string word; words >> word;)
  {
    const auto count = detail::parseValue<std::uint32_t>(word);
    if (!count || *count == 0 || *count > ParticleOptions::kMostParticles)
    {
      failInExperiment(fmt::format("bad value {} for 'particles_count': from 1 to {}",
                                   detail::quoted(word), ParticleOptions::kMostParticles));
    }
    counts.push_back(*count);
  }
  return counts;
}

/// Reads what pf-localization judges a run by.
void readJudgement(const CConfigFileMemory& ini, LocalizationSetup& setup)
{
  // Below 0, pf-localization's default, there is no such test.
  if (readNumber(ini, "experimentTestConvergenceAtStep", -1) >= 0)
  {
    setup.convergence_test_step = readCount(ini, "experimentTestConvergenceAtStep", 0);
  }
  setup.confidence_share = readNumber(ini, "STATS_CONF_INTERVAL", setup.confidence_share);
  if (setup.confidence_share <= 0 || setup.confidence_share >= 1)
  {
    failInExperiment("'STATS_CONF_INTERVAL' is not between 0 and 1");
  }
  setup.initial_odometry = {readNumber(ini, "initial_odo_x", 0),
                            readNumber(ini, "initial_odo_y", 0),
                            readNumber(ini, "initial_odo_phi", 0)};
}

/// Whether MRPT's particle filter tracks the robot instead of our own tracker.
bool readTracker(const CConfigFileMemory& ini)
{
  const std::string name = ini.read_string_first_word(kExperiment, "tracker", "gaussians");
  if (name != "gaussians" && name != "particles")
  {
    failInExperiment(
        fmt::format("'tracker' is {}, neither gaussians nor particles", detail::quoted(name)));
  }
  return name == "particles";
}

/// Where that cannot be determined, the reader of the file reports the error.
bool mayExist(const fs::path& path)
{
  std::error_code error;
  return fs::status(path, error).type() != fs::file_type::not_found;
}

/// Finds a file that an ini names: in the folder of the ini, then from the current folder.
fs::path findFile(const fs::path& named, const fs::path& ini, const char* key)
{
  const fs::path beside = ini.parent_path() / named;  // `named` itself where it is absolute
  if (mayExist(beside)) return beside.lexically_normal();
  if (mayExist(named)) return named;
  throw std::runtime_error(fmt::format("'{}' names {}, which does not exist{}", key, named.string(),
                                       detail::didYouMeanFile(beside)));
}

/// Returns "; did you mean it by '...'?" with the one of `present` that is nearest to what is
/// missing.
std::string didYouMeanItBy(const std::string& missing, const std::vector<std::string>& present)
{
  const std::string nearest = detail::nearestWord(missing, present);
  return nearest.empty() ? "" : "; did you mean it by '" + nearest + "'?";
}

/// Finds a file without which there is no run.
fs::path findInput(const CConfigFileMemory& ini, const fs::path& path, const char* key)
{
  const fs::path named = ini.read_string(kExperiment, key, "");
  if (!named.empty()) return findFile(named, path, key);
  const std::vector<std::string> unread = detail::unreadKeys(ini, kExperiment);
  throw std::runtime_error(fmt::format("'{}' is missing{}", key, didYouMeanItBy(key, unread)));
}

void readExperiment(const CConfigFileMemory& ini, const fs::path& path, const fs::path& rawlog,
                    const fs::path& map, LocalizationSetup& setup)
{
  if (!ini.sectionExists(kExperiment))
  {
    std::vector<std::string> sections;
    ini.getAllSections(sections);
    const std::string meant = didYouMeanItBy(kExperiment, sections);
    throw std::runtime_error(
        fmt::format("no section [{}]{}", kExperiment, meant.empty() ? kMapAndLog : meant));
  }
  for (const std::string& unread : detail::warningsOfUnreadKeys(ini, kExperiment))
    setup.warnings.push_back(unread);
  setup.use_particles = readTracker(ini);
  const std::string ignored = detail::warningOfIgnoredKeys(ini, kExperiment, setup.use_particles);
  if (!ignored.empty()) setup.warnings.push_back(ignored);
  const auto named = [&](const char* key) { return ini.read_string(kExperiment, key, ""); };
  setup.map_file = map.empty() ? findInput(ini, path, "map_file") : map;
  setup.rawlog_file = rawlog.empty() ? findInput(ini, path, "rawlog_file") : rawlog;
  const std::string truth = named("ground_truth_path_file");
  if (!truth.empty()) setup.ground_truth_file = findFile(truth, path, "ground_truth_path_file");
  setup.output_folder = named("logOutput_dir");
  setup.rawlog_offset = readCount(ini, "rawlog_offset", 0);
  setup.scene_frequency = readCount(ini, "3DSceneFrequency", 0);
  setup.repetitions = readRepetitions(ini);
  readJudgement(ini, setup);
  setup.prior = readPrior(ini);
  setup.stats_only = readSwitch(ini, "SAVE_STATS_ONLY");
  if (setup.use_particles) setup.particle_counts = readParticleCounts(ini);
}

/// Runs `read` on the parsed ini and puts the path before whatever it throws. `hint` tells what to
/// do with a file that is no ini.
template <class Read>
LocalizationSetup parsed(const fs::path& path, const std::string& hint, Read&& read)
{
  const std::string text = readIniText(path, hint);
  try
  {
    CConfigFileMemory ini;
    ini.setContent(text);
    LocalizationSetup setup;
    std::vector<std::string> sections(kSections.begin(), kSections.end());
    sections.emplace_back(kExperiment);
    setup.warnings = detail::warningsOfLines(text, sections);
    setup.config_file = path;
    readSections(ini, setup);
    read(ini, setup);
    return setup;
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error(path.string() + ": " + oneLine(error.what()));
  }
}
}  // namespace

std::string readIniText(const fs::path& path, const std::string& advice)
{
  constexpr std::uintmax_t kMost = 1U << 20U;  // bytes
  detail::requireFile(path);
  if (fs::file_size(path) > kMost) detail::fail(path, "not an ini file: more than 1 MB" + advice);
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  if (!file) detail::fail(path, "cannot be read");
  if (text.str().find('\0') != std::string::npos) detail::fail(path, "not an ini file" + advice);
  return text.str();
}

std::vector<fs::path> LocalizationSetup::inputFiles() const
{
  std::vector<fs::path> files = filesOfMapSource(map_file);
  files.insert(files.end(), {config_file, rawlog_file, ground_truth_file});
  return files;
}

mrpt::math::TPose2D LocalizationSetup::mapFromTruth() const
{
  return {report.map_from_truth_x, report.map_from_truth_y,
          mrpt::DEG2RAD(report.map_from_truth_phi_deg)};
}

std::optional<mrpt::math::TPose2D> LocalizationSetup::finalTruth() const
{
  if (!report.use_final_truth) return std::nullopt;
  return mrpt::math::TPose2D(report.final_truth_x, report.final_truth_y,
                             mrpt::DEG2RAD(report.final_truth_phi_deg));
}

void requireMapAndLog(const LocalizationSetup& setup)
{
  const auto& [map, log] = std::tie(setup.map_file, setup.rawlog_file);
  const auto is_map = [](const fs::path& path) { return detail::mapKindOf(path).has_value(); };
  const auto is_log = [](const fs::path& path)
  { return detail::isCarmenLog(path) || detail::extensionOf(path) == ".rawlog"; };
  // The name of a CARMEN log is that of a map, too.
  if (!is_log(map) || !is_map(log) || (is_map(map) && is_log(log))) return;
  const char* const meant =
      setup.config_file.empty() ? "--map {} --log {}" : "map_file = {} and rawlog_file = {}";
  throw std::runtime_error(fmt::format("map and log look swapped; did you mean {}?",
                                       fmt::format(meant, log.string(), map.string())));
}

LocalizationSetup readLocalizationSetup(const fs::path& ini_path, const fs::path& rawlog,
                                        const fs::path& map)
{
  return parsed(ini_path, kMapAndLog,
                [&](const CConfigFileMemory& ini, LocalizationSetup& setup)
                { readExperiment(ini, ini_path, rawlog, map, setup); });
}

LocalizationSetup readOptionSections(const fs::path& ini_path)
{
  return parsed(ini_path, "", [](const CConfigFileMemory&, LocalizationSetup&) {});
}

std::string defaultOptionSections()
{
  CConfigFileMemory ini;
  const LocalizationSetup setup;
  saveOptions(setup.matcher, ini, kMatcher);
  saveOptions(setup.tracker, ini, kTracker);
  saveOptions(setup.particles, ini, kParticles);
  saveOptions(setup.features, ini, kFeatures);
  saveOptions(setup.map, ini, kMap);
  saveOptions(setup.reading, ini, kReading);
  saveOptions(setup.report, ini, kReport);
  return ini.getContent();
}

}  // namespace sigloc
