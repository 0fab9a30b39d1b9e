// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace limber {

/// Whether a file is, by its extension, a deck of Nastran, Abaqus or CalculiX,
/// which may have its materials.
[[nodiscard]] bool has_deck_name(const std::filesystem::path& file);

}  // namespace limber
