// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limber {

/// Build ID of the program, or of Limber's file in another one (own_file.hpp):
/// the digest of its content that the linker embeds (`--build-id`), in
/// hexadecimal digits; empty if it has none. The same sources and tools give
/// the same ID.
///
/// Source     note NT_GNU_BUILD_ID of the ELF file
/// Limits     does not cover shared libraries
[[nodiscard]] std::string find_build_id();

}  // namespace limber
