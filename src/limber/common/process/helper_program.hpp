// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace limber {

/// Whether this user may run the file as a program.
[[nodiscard]] bool can_run(const std::filesystem::path& program);

/// A program that Limber starts, by name: beside its own file
/// (files/own_file.hpp), in ../libexec/limber from there, or where Limber was
/// configured to be installed.
/// @param what its purpose in messages, such as "the mesher"
/// @param remedy last sentence of the error
/// @throws InputError if it is in none of these places
[[nodiscard]] std::filesystem::path find_helper(const std::string& what,
                                                const std::string& name,
                                                const std::string& remedy);

/// Replaces this program by another one in the same process, with its
/// streams and its parent. Signal handlers, threads and memory are
/// lost.
/// @param argv ended by a null pointer
/// @throws InputError if it cannot be started
[[noreturn]] void become(const std::filesystem::path& program, char** argv);

}  // namespace limber
