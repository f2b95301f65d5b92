// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "manual.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace sigloc
{
namespace
{
/// Text as roff takes it: a hyphen is one that can be copied, and no line is taken for a request.
std::string roff(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
  {
    const bool first = escaped.empty() || escaped.back() == '\n';
    if (first && (c == '.' || c == '\'')) escaped += "\\&";
    escaped += c == '-' ? "\\-" : c == '\\' ? "\\e" : std::string(1, c);
  }
  return escaped;
}

/// A description as it follows a name and a dash: no capital first, no stop at the end.
std::string nameLine(std::string text)
{
  const bool word = text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])) != 0;
  if (word) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  if (!text.empty() && text.back() == '.') text.pop_back();
  return text;
}

/// What --help shows: options of no group are hidden.
std::vector<const CLI::Option*> shownOptions(const CLI::App& command)
{
  return command.get_options([](const CLI::Option* option)
                             { return !option->get_group().empty(); });
}

std::vector<const CLI::App*> commandsOf(const CLI::App& app)
{
  return app.get_subcommands([](const CLI::App* command) { return !command->get_name().empty(); });
}

/// A required option as it is typed, with the name of its value: -i INPUT.
std::string typedWithValue(const CLI::Option& option)
{
  std::string value = option.get_lnames().empty() ? "VALUE" : option.get_lnames().back();
  std::transform(value.begin(), value.end(), value.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const bool is_short = !option.get_snames().empty();
  return (is_short ? "-" + option.get_snames().front() : option.get_name()) + " " + value;
}

std::string synopsis(const CLI::App& command, const std::string& called)
{
  std::string line = called;
  std::string positionals;
  for (const CLI::Option* option : shownOptions(command))
  {
    const std::string name = option->get_name();
    const bool required = option->get_required();
    if (option->get_positional()) positionals += required ? " " + name : " [" + name + "]";
    if (!option->get_positional() && required) line += " " + typedWithValue(*option);
  }
  line += " [OPTIONS]" + positionals;
  if (!commandsOf(command).empty()) line += " COMMAND ...";
  return line;
}

std::string optionEntries(const CLI::App& command)
{
  const CLI::Formatter formatter;
  std::string entries;
  for (const CLI::Option* option : shownOptions(command))
  {
    const bool positional = option->get_positional() && !option->nonpositional();
    const std::string name = option->get_name(positional, !positional);
    entries +=
        fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", roff(name), roff(formatter.make_option_opts(option)),
                    roff(formatter.make_option_desc(option)));
  }
  return entries;
}

std::string names(const std::vector<const CLI::App*>& commands, const std::string& between)
{
  std::string joined;
  for (const CLI::App* command : commands)
  {
    joined += (joined.empty() ? "" : between) + command->get_name();
  }
  return joined;
}

/// The options as they are typed: -o --output.
std::string typedOptions(const CLI::App& command)
{
  std::string typed;
  for (const CLI::Option* option : shownOptions(command))
  {
    for (const std::string& name : option->get_snames()) typed += " -" + name;
    for (const std::string& name : option->get_lnames()) typed += " --" + name;
  }
  return typed.empty() ? typed : typed.substr(1);
}
}  // namespace

std::string manPage(const CLI::App& app, const std::string& source)
{
  const std::string& name = app.get_name();
  std::string title = name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string page = fmt::format(
      ".TH \"{}\" 1 \"\" \"{}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}\n"
      ".SH DESCRIPTION\n{}\n.SH OPTIONS\n{}",
      roff(title), source, roff(name), roff(nameLine(app.get_description())),
      roff(synopsis(app, name)), roff(app.get_description()), optionEntries(app));
  const auto commands = commandsOf(app);
  if (!commands.empty()) page += ".SH COMMANDS\n";
  for (const CLI::App* command : commands)
  {
    page +=
        fmt::format(".SS {}\n{}\n{}", roff(synopsis(*command, name + " " + command->get_name())),
                    roff(command->get_description()), optionEntries(*command));
  }
  if (!app.get_footer().empty()) page += ".SH NOTES\n" + roff(app.get_footer()) + "\n";
  return page;
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const
{
  return "Usage: " + synopsis(*app, name) + "\n";
}

std::string usage(const CLI::App& app)
{
  const auto given = app.get_subcommands();
  if (given.empty()) return synopsis(app, app.get_name());
  return synopsis(*given.front(), app.get_name() + " " + given.front()->get_name());
}

std::string bashCompletion(const CLI::App& app)
{
  const std::string& name = app.get_name();
  std::string function = "_" + name;
  std::replace(function.begin(), function.end(), '-', '_');
  const auto commands = commandsOf(app);
  std::string script = fmt::format(
      "# bash completion for {}\n{}()\n{{\n"
      "  local word options=\"{}\" commands=\"{}\"\n",
      name, function, typedOptions(app), names(commands, " "));
  if (!commands.empty())
  {
    script +=
        "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
        "    case $word in\n";
    for (const CLI::App* command : commands)
    {
      script += fmt::format("      {}) options=\"{}\" commands=\"\"; break ;;\n",
                            command->get_name(), typedOptions(*command));
    }
    script += "    esac\n  done\n";
  }
  script += fmt::format(
      "  word=${{COMP_WORDS[COMP_CWORD]}}\n"
      "  if [[ $word == -* ]]; then commands=$options; fi\n"
      "  mapfile -t COMPREPLY < <(compgen -W \"$commands\" -- \"$word\")\n"
      "}}\n"
      "complete -o default -F {} {}\n",
      function, name);
  return script;
}
}  // namespace sigloc
