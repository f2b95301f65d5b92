// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "wrong_use.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "manual.h"
#include "sigloc/config/option_fields.h"

namespace sigloc
{
namespace
{
std::vector<std::string> commandNames(const CLI::App& app)
{
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// The options of the program and of the command that was given.
std::vector<const CLI::Option*> optionsInUse(const CLI::App& app)
{
  std::vector<const CLI::Option*> options = app.get_options();
  for (const CLI::App* command : app.get_subcommands())
  {
    const auto more = command->get_options();
    options.insert(options.end(), more.begin(), more.end());
  }
  return options;
}

bool lacksCommand(const CLI::App& app)
{
  return app.get_require_subcommand_min() > 0 && app.get_subcommands().empty();
}

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Returns a hint at the known option that ends as the given one does, as --log and --rawlog, or an
/// empty text.
std::string endingAlike(const std::string& option, const std::vector<std::string>& known)
{
  constexpr std::size_t kDashes = 2;
  constexpr std::size_t kShortest = 3;  // letters that must be alike
  for (const std::string& name : known)
  {
    if (std::min(option.size(), name.size()) < kDashes + kShortest || name[0] != '-') continue;
    const std::string stem = name.substr(kDashes);
    const std::string given = option.substr(kDashes);
    if (endsWith(stem, given) || endsWith(given, stem)) return "; did you mean '" + name + "'?";
  }
  return {};
}

/// What is wrong with the first word that the program does not know.
std::string unknownWord(const CLI::App& app)
{
  const std::string word = app.remaining(true).front();
  const bool option = word.rfind('-', 0) == 0;
  const bool command = lacksCommand(app);
  const std::string what = option    ? "no such option: "
                           : command ? "no such command: "
                                     : "one argument too many: ";
  std::vector<std::string> known = commandNames(app);
  for (const CLI::Option* shown : optionsInUse(app))
  {
    for (const std::string& name : shown->get_lnames()) known.push_back("--" + name);
  }
  const std::string name = word.substr(0, word.find('='));
  std::string hint = didYouMean(name, known);
  if (option && hint.empty()) hint = endingAlike(name, known);
  if (!hint.empty()) return what + word + hint;
  return what + word + (option || command ? "; see --help" : "; type: " + usage(app));
}

/// What is missing, a command or what CLI11 names.
std::string missingWord(const CLI::App& app, const std::string& told)
{
  if (lacksCommand(app))
    return fmt::format("no command given: {}; see --help", fmt::join(commandNames(app), ", "));
  if (told.rfind('-', 0) != 0) return told + "; type: " + usage(app);
  const auto given = app.get_subcommands();
  return fmt::format("{}; see {}{} --help", told, app.get_name(),
                     given.empty() ? "" : " " + given.front()->get_name());
}

/// What is wrong with the number of an option's values.
std::string wrongCount(const CLI::Option& option)
{
  const std::string name = option.get_name();
  const int needed = option.get_items_expected_max();
  const std::size_t given = option.count();
  if (needed == 1 && given > 1) return fmt::format("{} is given {} times; give one", name, given);
  if (needed == 1) return name + " needs a value; see --help";
  return fmt::format("{} needs {} values, not {}: {}", name, needed, given,
                     option.get_description());
}

/// What is wrong with a value that is no number, or follows a flag.
std::string wrongValue(const CLI::Option& option)
{
  if (option.get_items_expected_max() == 0) return option.get_name() + " takes no value";
  return fmt::format("{}: bad value '{}'", option.get_name(), fmt::join(option.results(), ","));
}
}  // namespace

std::string wrongUse(const CLI::App& app, const CLI::ParseError& error)
{
  std::string told = error.what();
  const bool lacks = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  // CLI11 would call a word that is no command a missing one.
  if ((lacks || extra) && !app.remaining(true).empty()) return unknownWord(app);
  if (lacks) return missingWord(app, told);
  const bool count = dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr;
  const bool value = dynamic_cast<const CLI::ConversionError*>(&error) != nullptr;
  for (const CLI::Option* option : optionsInUse(app))
  {
    const std::string name = option->get_name();
    if (count && told.rfind(name + ":", 0) == 0) return wrongCount(*option);
    if (value && told.find(": " + name + " = ") != std::string::npos) return wrongValue(*option);
  }
  return told;
}
}  // namespace sigloc
