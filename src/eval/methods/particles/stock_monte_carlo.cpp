// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/poses/CPosePDFParticles.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <stdexcept>

#include "eval/methods/particles/MonteCarloSettings.h"
#include "eval/methods/TrackingMethod.h"
#include "eval/process/child_process.h"
#include "io/text_rows.h"
#include "sigloc/io/file_output.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* kProgram = "pf-localization";
constexpr const char* kPackage = "mrpt-apps";

/// A folder that the destructor removes.
class TemporaryFolder
{
 public:
  TemporaryFolder()
  {
    std::string pattern = (fs::temp_directory_path() / "sigloc-stock-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
    {
      throw std::runtime_error(pattern + ": cannot be made");
    }
    path_ = pattern;
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void writeDrive(const std::vector<RawlogStep>& steps, const MonteCarloSettings& settings,
                const fs::path& path)
{
  const auto write = [&](mrpt::serialization::CArchive& archive)
  {
    for (const RawlogStep& step : steps) archive << actionsOf(step, settings) << *step.frame;
  };
  writeObjects(path, write);
}

/// The options of `mcl`, and the section that names files. Particles are written every step. This
/// is the only way to get the program's estimate.
std::string configurationOf(const MonteCarloSettings& settings, const fs::path& map,
                            const fs::path& drive, const fs::path& out)
{
  const PoseRegion region = startRegionOf(settings);
  constexpr double kDegrees = 180 / M_PI;
  return toIni(settings) +
         fmt::format(
             "\n[LocalizationExperiment]\nmap_file={}\nrawlog_file={}\nlogOutput_dir={}\n"
             "particles_count={}\nexperimentRepetitions=1\n3DSceneFrequency=1\n"
             "SHOW_PROGRESS_3D_REAL_TIME=false\ninit_PDF_mode=0\ninit_PDF_min_x={:.12g}\n"
             "init_PDF_max_x={:.12g}\ninit_PDF_min_y={:.12g}\ninit_PDF_max_y={:.12g}\n"
             "init_PDF_min_yaw_deg={:.12g}\ninit_PDF_max_yaw_deg={:.12g}\n",
             map.string(), drive.string(), out.string(), settings.particles, region.x_min,
             region.x_max, region.y_min, region.y_max,
             kDegrees * (region.heading - region.heading_tolerance),
             kDegrees * (region.heading + region.heading_tolerance));
}

/// Runs the program and writes all its output to `log`. Its standard input is empty, because at
/// errors it waits for a key.
void runStock(const fs::path& ini, const fs::path& log)
{
  const auto status = detail::runProgram(kProgram, ini.string(), log);
  if (!status)
  {
    throw std::runtime_error(
        fmt::format("{}: cannot be run (it is in the package {})", kProgram, kPackage));
  }
  if (*status != 0)
  {
    throw std::runtime_error(fmt::format("{}: failed with status {}", kProgram, *status));
  }
}

/// Reads rows `x y yaw log_weight` under a line of heads.
mrpt::poses::CPosePDFParticles readParticles(const fs::path& path)
{
  std::ifstream file(path);
  file.imbue(std::locale::classic());
  std::string head;
  std::getline(file, head);
  mrpt::poses::CPosePDFParticles particles;
  particles.clearParticles();
  mrpt::poses::CPosePDFParticles::CParticleData data;
  while (file >> data.d.x >> data.d.y >> data.d.phi >> data.log_w)
  {
    particles.m_particles.push_back(data);
  }
  if (particles.m_particles.empty()) throw std::runtime_error(path.string() + ": no particles");
  return particles;
}

/// Returns the times [ms] that the program prints for its steps. Before the first one it draws the
/// particles; the first step is not executed.
std::vector<double> toldTimes(const fs::path& folder, const fs::path& log)
{
  std::ifstream printed(log);
  const std::string text(std::istreambuf_iterator<char>(printed), {});
  std::smatch found;
  std::vector<double> times = {0};
  if (std::regex_search(text, found, std::regex("particles initialized in ([0-9.]+)ms")))
  {
    times.front() = detail::toNumber(found[1].str()).value_or(0);
  }
  std::ifstream file(folder / "exec_times.txt");
  file.imbue(std::locale::classic());
  for (double seconds = 0; file >> seconds;) times.push_back(1e3 * seconds);
  return times;
}

fs::path onlyFolderIn(const fs::path& parent)
{
  for (const auto& entry : fs::directory_iterator(parent))
  {
    if (entry.is_directory()) return entry.path();
  }
  throw std::runtime_error(std::string(kProgram) + ": wrote nothing");
}

std::vector<TimedClaim> readClaims(const fs::path& folder, const fs::path& log, std::size_t steps)
{
  const std::vector<double> times = toldTimes(folder, log);
  if (times.size() != steps)
  {
    throw std::runtime_error(fmt::format("{}: made {} of {} steps", kProgram, times.size(), steps));
  }
  std::vector<TimedClaim> claims(steps);
  TightCloud cloud;
  for (std::size_t i = 0; i < steps; ++i)
  {
    const fs::path file = folder / "particles" / fmt::format("particles_{:05}.txt", i);
    const auto [covariance, mean] = readParticles(file).getCovarianceAndMean();
    claims[i] = {cloud.claim(mean, covariance), times[i]};
  }
  return claims;
}

/// One process of the stock program.
class StockMonteCarlo : public TrackingMethod
{
 public:
  StockMonteCarlo(fs::path map, const MonteCarloSettings& settings)
      : map_(std::move(map)), settings_(settings)
  {
  }

  std::vector<TimedClaim> drive(const std::vector<RawlogStep>& steps) override
  {
    const TemporaryFolder folder;
    const fs::path drive = folder.path() / "drive.rawlog";
    const fs::path ini = folder.path() / "mcl.ini";
    const fs::path log = folder.path() / "printed.txt";
    const fs::path out = folder.path() / "out";
    writeDrive(steps, settings_, drive);
    writeFile(ini, configurationOf(settings_, map_, drive, out / "mcl"));
    fs::create_directory(out);
    runStock(ini, log);
    return readClaims(onlyFolderIn(out), log, steps.size());
  }

 private:
  fs::path map_;
  MonteCarloSettings settings_;
};

class StockFactory : public TrackingMethodFactory
{
 public:
  StockFactory(const EvaluationMap& map, const MonteCarloSettings& settings)
      : settings_(settings), map_(map.file)
  {
    if (isSimplemap(map.file)) return;
    // A grid that holds the right likelihood options, which the program reads from it.
    map_ = folder_.path() / "map.gridmap.gz";
    const auto maps = localizationMapOf(map, toIni(settings_));
    const auto grid = maps->mapByClass<mrpt::maps::COccupancyGridMap2D>();
    writeObjects(map_, [&](mrpt::serialization::CArchive& archive) { archive << *grid; });
  }

  std::unique_ptr<TrackingMethod> start(std::uint32_t /*seed*/) const override
  {
    return std::make_unique<StockMonteCarlo>(fs::absolute(map_), settings_);
  }

 private:
  TemporaryFolder folder_;
  MonteCarloSettings settings_;
  fs::path map_;
};
}  // namespace

std::unique_ptr<TrackingMethodFactory> detail::makeStockMonteCarlo(
    const EvaluationMap& map, const RelocationMethodOptions& options)
{
  if (!map.features->field()) throw std::invalid_argument("mcl-stock needs a map with a grid");
  return std::make_unique<StockFactory>(map, monteCarloSettings("mcl-stock", 0, options));
}
}  // namespace sigloc
