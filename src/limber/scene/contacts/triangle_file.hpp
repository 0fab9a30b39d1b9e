// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/scene/robot/geometry.hpp"

namespace limber::scene {

/// Corners, outward (right-hand), in the file's unit.
using Triangle = std::array<Vector3, 3>;

/// The triangles of an STL file (text or binary), of an OBJ file, whose
/// polygons are split from their first corner, or of a COLLADA file
/// (dae_file.hpp). Lines, points, normals, colours and groups are not read.
/// @throws InputError naming the file, and the line or triangle: a file that
/// cannot be read, of another kind or damaged, without triangles, with more
/// than 500 000, or with a coordinate that is no finite number.
[[nodiscard]] std::vector<Triangle> read_triangles(
    const std::filesystem::path& file);

/// The same with the mesh's scale [m].
[[nodiscard]] std::vector<Triangle> read_triangles(const MeshGeometry& mesh);

}  // namespace limber::scene
