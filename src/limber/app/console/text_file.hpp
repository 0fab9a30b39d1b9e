// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace limber::app {

/// Writes `text` and a newline. @throws InputError if that fails.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace limber::app
