// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace limber {

/// Makes Limber use the file that contains `code` as its own, for programs of
/// others such as Python. To be called once, before anything else.
/// @param code address of a function of Limber
void set_own_code(const void* code);

/// That address; null: Limber is the program itself.
[[nodiscard]] const void* find_own_code();

/// The program, or the file that set_own_code chose. Other files of the
/// installation are found from its folder.
/// @returns empty if the system does not provide it
[[nodiscard]] std::filesystem::path find_own_file();

}  // namespace limber
