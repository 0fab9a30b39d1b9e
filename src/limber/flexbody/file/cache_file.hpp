// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

namespace limber::flexbody {

/// Whether a cache file may be trusted: a regular file of the user or the
/// administrator that nobody else can write.
[[nodiscard]] bool is_own_file(const std::filesystem::path& file);

/// Records that an entry was used now, by its time of modification.
void note_use(const std::filesystem::path& file);

/// Creates the folder, accessible to its owner only, and the file by `write`,
/// writable by its owner only.
/// @throws on any failure to write
void write_own_file(
    const std::filesystem::path& file,
    const std::function<void(const std::filesystem::path&)>& write);

}  // namespace limber::flexbody
