// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "flexbody/reduced_body.hpp"

namespace limber::flexbody {

/// Version of the layout that `write_body` writes.
inline constexpr int kBodyFileVersion = 7;

/// Writes one self-describing HDF5 file (every dataset carries its unit and
/// meaning), atomically: who reads `file` meanwhile finds the old one or the
/// new one, and of several writers the last one wins. HDF5's user block, the
/// first 512 bytes, holds a seal: lines of text with the layout's version and
/// a digest of all bytes behind it.
/// @throws InputError if the place cannot be written.
void write_body(const ReducedBody& body, const std::filesystem::path& file);

/// @throws InputError if the file is missing, truncated, corrupt (a single bit
/// is enough), of another version, or holds values that are not finite or of
/// wrong size.
[[nodiscard]] ReducedBody read_body(const std::filesystem::path& file);

/// Renews the seal of a file that was changed on purpose, by another tool.
/// @throws InputError if it cannot be read or written.
void seal_body_file(const std::filesystem::path& file);

}  // namespace limber::flexbody
