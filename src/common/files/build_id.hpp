// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limber {

/// Which build the running program is: the digest of what it is made of that
/// its linker put into it (`--build-id`), in hexadecimal digits; empty if it
/// has none. The same sources and tools give the same one.
///
/// Source     note NT_GNU_BUILD_ID of the program's ELF file
/// Limits     says nothing of shared libraries
[[nodiscard]] std::string find_build_id();

}  // namespace limber
