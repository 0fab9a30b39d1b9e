// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace limber {

/// Has Limber take the file that contains `code` for its own in place of the
/// program, which is another one, as Python. Once, before anything else.
/// @param code address of a function of Limber
void set_own_code(const void* code);

/// That address; null: Limber is the program itself.
[[nodiscard]] const void* find_own_code();

/// The program, or the file that set_own_code chose. Other files of the
/// installation are found from its folder.
/// @returns empty if the system does not tell
[[nodiscard]] std::filesystem::path find_own_file();

}  // namespace limber
