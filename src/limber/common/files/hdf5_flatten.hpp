// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/common/files/flat_file.hpp"

namespace limber {

/// All datasets of a file that Hdf5File wrote: matrices, lists of integers and
/// texts. The user block is left empty.
/// @throws InputError if it cannot be read, or has values of another kind.
[[nodiscard]] FlatFile flatten_hdf5(const std::filesystem::path& file);

}  // namespace limber
