// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/progress.hpp"
#include "fem/material.hpp"
#include "fem/matrices.hpp"
#include "fem/mesh.hpp"

namespace limber::fem {

/// Consistent mass and stiffness of the mesh, one material per region.
/// In parallel; bitwise the same for any number of threads.
/// @throws InputError if the matrix has more entries than an int can count.
[[nodiscard]] StructuralMatrices assemble(
    const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
    const Progress& progress = {});

}  // namespace limber::fem
