// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace limber::mesher {

/// How a geometry is kept from doing more than reading files.
enum class Sandbox {
  kernel,       ///< the kernel denies the calls, and this process ends with a
                ///< message
  text_search,  ///< no kernel support: files with dangerous commands are not
                ///< opened
};

/// Restricts this process: from now on it can run no program, create no
/// process, change no file and use no network (seccomp; where the kernel has
/// none, Landlock). An attempt fails.
[[nodiscard]] Sandbox enter_sandbox();

/// From now on an attempt ends the process with a message on standard error and
/// exit status fem::kMesherRefused.
void report_violations();

/// The first command in a Gmsh geometry that runs programs or writes files, if
/// `text` has one outside comments and strings.
[[nodiscard]] std::optional<std::string> find_dangerous_command(
    std::string_view text);

/// Whether a Gmsh geometry depends on more than files: clock, memory, random
/// numbers. Comments are searched too.
[[nodiscard]] bool has_unrepeatable_command(std::string_view text);

}  // namespace limber::mesher
