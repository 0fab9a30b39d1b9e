// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/global_flags.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <string_view>

#include "limber/app/console/help_text.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/console/verbosity.hpp"
#include "limber/common/errors.hpp"

namespace limber::app {
namespace {

/// Commands whose output is their result.
constexpr std::array<std::string_view, 7> kAnswersOnScreen = {
    "cache", "frequencies", "info", "modes", "operate", "schema", "wobble"};

bool prints_answer(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    const CLI::Option* json = command->get_option_no_throw("--json");
    if (json != nullptr && json->count() > 0) return true;
    if (std::count(kAnswersOnScreen.begin(), kAnswersOnScreen.end(),
                   command->get_name()) > 0) {
      return true;
    }
  }
  return false;
}

void discard_output() {
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  dup2(nowhere, STDOUT_FILENO);
  close(nowhere);
}

double to_seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) +
         1e-6 * static_cast<double>(time.tv_usec);
}

void add_to(CLI::App& command, const SharedGlobalFlags& flags) {
  command.add_flag(
      "-q,--quiet", flags->quiet,
      "Only warnings and errors: no progress, no summary of results in files");
  command.add_flag("-v,--verbose", flags->verbose,
                   "Also each step of the work with its time");
  for (CLI::App* sub :
       command.get_subcommands([](CLI::App*) { return true; })) {
    add_to(*sub, flags);
  }
}

}  // namespace

SharedGlobalFlags add_global_flags(CLI::App& app) {
  auto flags = std::make_shared<GlobalFlags>();
  add_to(app, flags);
  return flags;
}

void follow_global_flags(const CLI::App& app, const GlobalFlags& flags) {
  if (flags.quiet && flags.verbose) {
    throw InputError("--quiet and --verbose exclude each other; give one");
  }
  if (flags.quiet) {
    set_verbosity(Verbosity::quiet);
    if (!prints_answer(app)) discard_output();
  }
  if (!flags.verbose) return;
  set_verbosity(Verbosity::verbose);
  std::istringstream lines(describe_build());
  for (std::string line; std::getline(lines, line);) print_notice(line);
}

void print_cost() {
  if (find_verbosity() != Verbosity::verbose) return;
  rusage used = {};
  if (getrusage(RUSAGE_SELF, &used) != 0) return;
  print_notice(
      fmt::format("{:.3g} s of processors, {} MiB of memory at most",
                  to_seconds(used.ru_utime) + to_seconds(used.ru_stime),
                  used.ru_maxrss / 1024));
}

}  // namespace limber::app
