// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// Reduced bodies whose content is wrong though HDF5's own structures and the
/// seal are right: what a tool can make that edits a body.
namespace limber::fuzz {

/// The bytes of a small body's file.
[[nodiscard]] const std::string& find_body_bytes();

/// Replaces datasets of a body's file, a line for each:
///
///     lambda f64 2x1 1e4 4e4      another shape, other numbers (f32, i8, i64)
///     counts i64 2 1000 0
///     name text hinge
///     rows/tags gone
///
/// Values that are missing are 0; a dataset of more than 4096 entries is left
/// without any. Impossible edits are ignored. The seal is not updated.
void apply_edits(std::string_view edits, const std::filesystem::path& file);

}  // namespace limber::fuzz
