// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "limber/flexbody/model/recipe.hpp"

namespace limber::scene {

/// Reads the `material elastic [ name = ..., rho = ..., E = ..., nu = ... ]`
/// sections of an Akantu input file. A single section applies to the whole
/// mesh; of several, each to the volume group of its name. nu is 0 by default.
/// @throws InputError with file and line: another law, a parameter that is
/// missing, unknown or out of range, a section that does not end.
[[nodiscard]] std::vector<flexbody::MaterialRegion> read_akantu_materials(
    const std::filesystem::path& file);

}  // namespace limber::scene
