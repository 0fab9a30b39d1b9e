// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

namespace limber::flexbody {

/// Whether a file of a cache may be read: a regular file of the user's own, or
/// of the administrator's, that nobody else can write.
[[nodiscard]] bool is_own_file(const std::filesystem::path& file);

/// Makes the folder, for its owner alone, and the file by `write`, which
/// nobody else can write.
/// @throws whatever keeps it from being written
void write_own_file(
    const std::filesystem::path& file,
    const std::function<void(const std::filesystem::path&)>& write);

}  // namespace limber::flexbody
