// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace limber {

/// Writes a file atomically: `write` creates it beside its destination, and it
/// is renamed when complete. An old file stays until then. A device or pipe is
/// written to directly.
/// @param write gets the path to write to, and throws on failure
/// @throws what `write` throws; InputError if it cannot be moved
void write_whole(
    const std::filesystem::path& file,
    const std::function<void(const std::filesystem::path&)>& write);

/// Likewise, of these bytes. @throws InputError naming the file if it cannot be
/// written
void write_whole(const std::filesystem::path& file, std::string_view bytes);

}  // namespace limber
