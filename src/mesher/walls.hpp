// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace limber::mesher {

/// What keeps a geometry from doing more than to read files.
enum class Walls {
  kernel,  ///< the kernel refuses the calls, and this process ends with words
  words,   ///< no such kernel: files with dangerous words are not opened
};

/// Puts up the walls: from now on this process runs no program, makes no other
/// process, changes no file and has no network (seccomp; where the kernel has
/// none, Landlock). An attempt fails.
[[nodiscard]] Walls put_up_walls();

/// From now on an attempt ends the process with words on standard error and
/// exit status fem::kMesherRefused.
void watch_walls();

/// A word of a Gmsh geometry that runs programs or writes files, if `text`
/// has one outside comments and strings.
[[nodiscard]] std::optional<std::string> find_dangerous_word(
    std::string_view text);

/// Whether a Gmsh geometry asks for what is not in files: clock, memory,
/// chance. Words in comments count too.
[[nodiscard]] bool has_fleeting_word(std::string_view text);

/// Ends the process: the file may not do `what`.
[[noreturn]] void refuse(std::string_view what);

}  // namespace limber::mesher
