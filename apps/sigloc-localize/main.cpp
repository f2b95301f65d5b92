// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// sigloc-localize: finds and tracks a lost robot in a known map, from a recorded log.
#include <mrpt/config/CConfigFileMemory.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>

#include "arguments.h"
#include "load_work.h"
#include "number_option.h"
#include "out_option.h"
#include "run_app.h"
#include "sigloc/io/map_files.h"

namespace
{
/// Whether an ini leaves pictures out. Where that cannot be told, the run says what is wrong.
bool wantsStatisticsOnly(const std::filesystem::path& path)
{
  constexpr std::streamsize kMostOfIni = 1U << 20U;  // bytes; a longer one is refused anyway
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;  // a pipe is read once only
  std::string text(kMostOfIni, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), kMostOfIni);
  text.resize(static_cast<std::size_t>(file.gcount()));
  try
  {
    mrpt::config::CConfigFileMemory ini;
    ini.setContent(text);
    const std::string value =
        ini.read_string_first_word("LocalizationExperiment", "SAVE_STATS_ONLY", "false");
    return sigloc::detail::parseValue<bool>(value).value_or(false);
  }
  catch (const std::exception&)
  {
    return false;
  }
}

sigloc::Pictures picturesOf(const sigloc::LocalizeArguments& arguments)
{
  const bool none =
      arguments.print_defaults ||
      (arguments.config.empty() ? !arguments.output : wantsStatisticsOnly(arguments.config));
  return none ? sigloc::Pictures::none : sigloc::Pictures::perhaps;
}
}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("Finds and follows a lost robot in a known map.", "sigloc-localize");
  sigloc::LocalizeArguments arguments;
  app.footer(
      "Exit codes: 0 done, 1 bad input or no room for the output (nothing written but the map's "
      "cache, $XDG_CACHE_HOME/sigloc or ~/.cache/sigloc; where standard output alone fails, the "
      "results are whole), 2 truncated log (results cover what was read).");
  auto* const config =
      app.add_option("CONFIG.ini", arguments.config, "configuration, as pf-localization reads it");
  auto* const rawlog =
      app.add_option("DATASET.rawlog", arguments.rawlog,
                     "log to use instead of rawlog_file; a CARMEN log (.log, .clf), too");
  auto* const map =
      app.add_option("--map", arguments.map,
                     "map to localize in, instead of map_file: " + sigloc::mapFormatNames() +
                         ". .gz or .zst may follow, but for ROS maps and images");
  auto* const log = app.add_option("--log", arguments.rawlog, "the same as DATASET.rawlog");
  arguments.reading.declare(app);
  app.add_option(sigloc::kOut, arguments.output, "output folder instead of logOutput_dir");
  app.add_option("--seed", arguments.seed, "seed instead of the one in [sigloc.matcher]")
      ->check(sigloc::numberFrom<std::uint32_t>(0, std::numeric_limits<std::uint32_t>::max()));
  app.add_flag("--quiet", arguments.quiet, "no progress");
  app.add_flag("--print-defaults", arguments.print_defaults,
               "print all [sigloc.*] sections and exit");
  const auto work = [&]
  {
    const bool complete = config->count() > 0 || (map->count() > 0 && log->count() > 0);
    if (!complete && !arguments.print_defaults)
    {
      throw std::runtime_error("needs --map MAP --log LOG.rawlog, or CONFIG.ini; see --help");
    }
    if (rawlog->count() > 0 && log->count() > 0)
    {
      throw std::runtime_error("two logs: --log " + log->as<std::string>() + " and the argument " +
                               rawlog->as<std::string>() + "; give one");
    }
    std::error_code ignored;
    if (config->count() > 0 && map->count() > 0 && log->count() > 0 &&
        !std::filesystem::exists(arguments.config, ignored))
    {
      throw std::runtime_error("one argument too many: " + arguments.config.string() +
                               ", which is no ini; --map and --log are enough");
    }
    if (arguments.output && arguments.output->empty()) throw std::runtime_error("--out is empty");
    return sigloc::loadWork<decltype(siglocLocalize)>("siglocLocalize",
                                                      picturesOf(arguments))(arguments);
  };
  return sigloc::runApp(app, argc, argv, work);
}
