// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace limber::app {

/// A possible next word of a command line.
struct Candidate {
  std::string word;
  std::string what;  ///< its help, one line
};

/// Long options of a command that begin with `start`; hidden ones are left out.
[[nodiscard]] std::vector<Candidate> list_options(const CLI::App& command,
                                                  const std::string& start);
/// The same of its subcommands.
[[nodiscard]] std::vector<Candidate> list_commands(const CLI::App& command,
                                                   const std::string& start);

/// Completions of the last word of a command line: subcommands, options, or
/// values of an option with a known list (levels, integrators, keys and names
/// of a scenario that the line has). Empty where a file or any text is
/// possible.
/// @param words of the command line after the program's name
[[nodiscard]] std::vector<Candidate> complete(
    const CLI::App& app, const std::vector<std::string>& words);

/// One candidate per line, word and help separated by a tab, for the functions
/// of shells (src/limber/app/shells).
[[nodiscard]] std::string to_lines(const std::vector<Candidate>& candidates);

}  // namespace limber::app
