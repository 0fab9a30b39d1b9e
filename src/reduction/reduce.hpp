// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress.hpp"
#include "flexbody/cache.hpp"
#include "flexbody/recipe.hpp"
#include "flexbody/reduced_body.hpp"

namespace limber::flexbody {

/// The offline part: mesh to matrices to modes to reduced body. Linked by
/// limber::reduction alone (Gmsh, CHOLMOD).
/// @throws InputError naming the file, group or value; NumericalError if an
/// eigenpair or a solve misses its tolerance.
[[nodiscard]] ReducedBody reduce(const Recipe& recipe,
                                 const Progress& progress = {});

/// For the cache: meshes are made by limber-mesh, and reduced as above.
[[nodiscard]] Reducer make_reducer(const Progress& progress = {});

}  // namespace limber::flexbody
