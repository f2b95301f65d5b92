// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "run_app.h"

namespace
{
struct Command
{
  const char* name;
  const char* description;
  sigloc::CommandSetup set_up;
};

constexpr std::array kCommands = {
    Command{"relocate", "find robots from one scan each, method by method", sigloc::setUpRelocate},
    Command{"scale", "cost of the feature modes against the size of map and scene",
            sigloc::setUpScale},
    Command{"landmarks", "relocation from landmarks alone, with local maps",
            sigloc::setUpLandmarks},
    Command{"sweep", "relocation in simulated worlds under conditions that are varied",
            sigloc::setUpSweep},
    Command{"track", "wake up lost and drive on, method by method", sigloc::setUpTrack},
    Command{"reference", "truth for a log of which only the last pose is known",
            sigloc::setUpReference},
    Command{"reliability", "does one scan tell right poses from wrong ones?",
            sigloc::setUpReliability},
    Command{"merge", "pool what several runs wrote", sigloc::setUpMerge},
};

std::string commandLine(int argc, char** argv)
{
  std::string line = "sigloc-eval";
  for (int i = 1; i < argc; ++i) line += std::string(" ") + argv[i];
  return line;
}
}  // namespace

int main(int argc, char** argv)
{
  CLI::App app{"Compares ways of finding a lost robot, on logs and in simulation.", "sigloc-eval"};
  app.require_subcommand(1);
  std::vector<std::pair<CLI::App*, std::function<int()>>> runs;
  for (const Command& command : kCommands)
  {
    CLI::App* sub = app.add_subcommand(command.name, command.description);
    runs.emplace_back(sub, command.set_up(*sub, commandLine(argc, argv)));
  }
  const auto work = [&]
  {
    for (const auto& [sub, run] : runs)
    {
      if (sub->parsed()) return run();
    }
    return 1;
  };
  return sigloc::runApp(app, argc, argv, work);
}
