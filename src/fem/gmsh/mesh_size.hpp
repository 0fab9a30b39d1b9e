// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

/// Sizes of elements beside the size of the part that Gmsh has open.
namespace limber::fem {

/// @param size wished for [mesh units]; 0 passes
/// @throws InputError if the part is more than 1000 times as large: its mesh
/// would have some 1e9 elements. The message has a size that is possible.
void check_element_size(const std::filesystem::path& file, double size);

/// Of a part whose surface is meshed: its volume over that of a regular
/// tetrahedron whose edge is the root mean square of the triangles' (1 / (6
/// sqrt 2) of its cube); 0 if the surface is not closed.
[[nodiscard]] double estimate_element_count();

}  // namespace limber::fem
