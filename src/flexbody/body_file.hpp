// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "flexbody/reduced_body.hpp"

namespace limber::flexbody {

/// Version of the layout that `write_body` writes.
inline constexpr int kBodyFileVersion = 1;

/// Writes one self-describing HDF5 file (every dataset carries its unit and
/// meaning), atomically. @throws InputError if the place cannot be written.
void write_body(const ReducedBody& body, const std::filesystem::path& file);

/// @throws InputError if the file is missing, truncated, corrupt, of another
/// version, or holds values that are not finite or of wrong size.
[[nodiscard]] ReducedBody read_body(const std::filesystem::path& file);

}  // namespace limber::flexbody
