// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace limber {

/// Type of a sealed file.
struct Seal {
  std::string_view kind;  ///< e.g. "limber checkpoint", one line
  int layout = 0;         ///< version of what follows
};

/// Writes three lines, kind, layout and digest (XXH3) of the rest, then
/// `content`. Atomic: the file exists completely or not at all.
/// @throws InputError if it cannot be written.
void write_sealed(const std::filesystem::path& file, const Seal& seal,
                  std::string_view content);

/// Whether the file begins with this kind's line. False if unreadable.
[[nodiscard]] bool has_seal(const std::filesystem::path& file,
                            std::string_view kind);

/// The content, after checking its digest.
/// @throws InputError if it is not a regular file, has another kind or layout,
/// or is damaged.
[[nodiscard]] std::string read_sealed(const std::filesystem::path& file,
                                      const Seal& seal);

}  // namespace limber
