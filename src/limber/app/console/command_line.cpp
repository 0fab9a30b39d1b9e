// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "limber/app/console/completion.hpp"
#include "limber/app/console/exit_status.hpp"
#include "limber/app/console/global_flags.hpp"
#include "limber/app/console/help_text.hpp"
#include "limber/app/console/manual.hpp"
#include "limber/app/console/process.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/common/echo.hpp"
#include "limber/common/names.hpp"

namespace limber::app {
namespace {

/// The innermost command that the words name.
const CLI::App& find_command(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : find_command(*chosen.front());
}

/// "limber cache list"
std::string find_full_name(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent == nullptr ? command.get_name()
                           : find_full_name(*parent) + " " + command.get_name();
}

std::vector<std::string> list_words(const std::vector<Candidate>& candidates) {
  std::vector<std::string> words;
  for (const Candidate& one : candidates) words.push_back(one.word);
  return words;
}

/// What is wrong with a command line: the first option or command in it that
/// is not known, with the nearest that is, or else the parser's message.
std::string explain(const CLI::App& app, const CLI::App& command,
                    const CLI::ParseError& error) {
  const std::vector<std::string> unknown = app.remaining(true);
  const auto option =
      std::find_if(unknown.begin(), unknown.end(), [](const std::string& word) {
        return word.size() > 1 && word.starts_with('-');
      });
  if (option != unknown.end()) {
    return describe_unknown("option", option->substr(0, option->find('=')),
                            list_words(list_options(command, "")));
  }
  const std::vector<std::string> commands =
      list_words(list_commands(command, ""));
  if (!unknown.empty() && !commands.empty()) {
    return describe_unknown("command", unknown.front(), commands);
  }
  constexpr std::size_t kUsual = 1000;  // all but what echoes long words
  const std::string text = error.what();
  return text.size() > kUsual ? echo(text) : text;
}

/// Help goes to standard output; a wrong command line is bad input.
int finish_parse(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    return run_guarded([&] { (void)app.exit(error); });
  }
  const CLI::App& command = find_command(app);
  print_error(fmt::format("{} (see {} --help)", explain(app, command, error),
                          find_full_name(command)));
  return kBadInput;
}

/// `limber __complete WORD...` for the functions of shells, `limber __manual
/// FOLDER` for the build; in no help. @returns whether it was one of them
bool answers_tool(const CLI::App& app, int argc, char** argv) {
  const std::string_view requested = argc > 1 ? argv[1] : "";
  if (requested == "__complete") {
    const std::vector<std::string> words(argv + 2, argv + argc);
    fmt::print("{}", to_lines(complete(app, words)));
    return true;
  }
  if (requested != "__manual" || argc != 3) return false;
  write_manuals(app, argv[2]);
  return true;
}

}  // namespace

int run_command_line(int argc, char** argv, const AddCommands& add_commands) {
  prepare_process();
  check_stack();
  check_address_space();
  CLI::App app("Simulates arms that bend.", "limber");
  app.set_version_flag("--version", describe_build(),
                       "Print the version and the options of its build");
  app.add_flag_callback(
      "--cite", [] { throw CLI::CallForVersion(describe_citation(), 0); },
      "Print how to cite Limber, for BibTeX");
  app.require_subcommand(1);
  Action action;
  add_commands(app, action);
  app.footer(describe_surroundings());  // of this help alone
  const SharedGlobalFlags flags = add_global_flags(app);
  bool is_answered = false;
  const int status =
      run_guarded([&] { is_answered = answers_tool(app, argc, argv); });
  if (is_answered || status != kSuccess) return end_process(status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return end_process(finish_parse(app, error));
  }
  return end_process(run_guarded([&] {
    follow_global_flags(app, *flags);
    action();
    print_cost();
  }));
}

}  // namespace limber::app
