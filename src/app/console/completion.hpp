// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace limber::app {

/// A word that may stand next on a command line.
struct Candidate {
  std::string word;
  std::string what;  ///< its help, one line
};

/// What the last word of a command line may become: subcommands, options, or
/// values of an option, of which there is a list (levels, integrators). None
/// where a file may stand, or any text.
/// @param words of the command line after the program's name
[[nodiscard]] std::vector<Candidate> complete(
    const CLI::App& app, const std::vector<std::string>& words);

/// A candidate a line, word and help with a tab between: what the functions of
/// shells read (src/app/shells).
[[nodiscard]] std::string to_lines(const std::vector<Candidate>& candidates);

}  // namespace limber::app
