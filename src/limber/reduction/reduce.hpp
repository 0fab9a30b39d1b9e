// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "limber/common/progress.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/flexbody/file/cache.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::flexbody {

/// Offline reduction: mesh to matrices to modes to reduced body. In
/// limber::reduction only (Gmsh, CHOLMOD).
/// @throws InputError naming the file, group or value; NumericalError if an
/// eigenpair or a solve misses its tolerance.
[[nodiscard]] ReducedBody reduce(const Recipe& recipe,
                                 const Progress& progress = {});

/// As above, of a mesh at hand in place of recipe.mesh.
[[nodiscard]] ReducedBody reduce(const Recipe& recipe,
                                 std::shared_ptr<const fem::TracedMesh> mesh,
                                 const Progress& progress = {});

/// For the cache: meshes by limber-mesh, reduced as above.
[[nodiscard]] Reducer make_reducer(const Progress& progress = {});

}  // namespace limber::flexbody
