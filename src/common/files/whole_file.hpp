// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

namespace limber {

/// A file is there whole or not at all: `write` makes it beside its place, to
/// where it is moved when it is done. What stood there stays until then. A
/// device or pipe is written to as it is.
/// @param write gets the path to write to, and throws on failure
/// @throws what `write` throws; InputError if it cannot be moved
void write_whole(
    const std::filesystem::path& file,
    const std::function<void(const std::filesystem::path&)>& write);

}  // namespace limber
