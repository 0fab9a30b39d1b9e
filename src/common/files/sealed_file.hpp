// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace limber {

/// What a sealed file says that it is.
struct Seal {
  std::string_view kind;  ///< e.g. "limber checkpoint", one line
  int layout = 0;         ///< version of what follows
};

/// Writes three lines, kind, layout and digest (XXH3) of all the rest, and
/// then `content`; the file is there whole or not at all.
/// @throws InputError if it cannot be written.
void write_sealed(const std::filesystem::path& file, const Seal& seal,
                  std::string_view content);

/// Whether the file begins with the kind's line. False if it cannot be read.
[[nodiscard]] bool has_seal(const std::filesystem::path& file,
                            std::string_view kind);

/// The content, if every byte of the file is as it was written.
/// @throws InputError if it is no regular file, of another kind or layout, or
/// damaged.
[[nodiscard]] std::string read_sealed(const std::filesystem::path& file,
                                      const Seal& seal);

}  // namespace limber
