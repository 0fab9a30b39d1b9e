// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

/// Sizes of elements beside the size of the part that Gmsh has open.
namespace limber::fem {

/// @param size wished for [mesh units]; 0 passes
/// @throws InputError if the part is more than 1000 times as large: its mesh
/// would have some 1e9 elements. The message has a size that is possible.
void check_element_size(const std::filesystem::path& file, double size);

/// At most about so many elements of this size: the volume of the box about the
/// part over that of a regular tetrahedron (1 / (6 sqrt 2) of the cube of its
/// edge); 0 for a size of 0.
[[nodiscard]] double estimate_element_count(double size);

}  // namespace limber::fem
