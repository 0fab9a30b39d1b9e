// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/solid/hyperelastic.hpp"
#include "limber/fem/solid/material.hpp"

namespace limber::fem {

struct StaticSettings {
  int load_steps = 10;         ///< number of equal increments of the load
  double tolerance = 1e-10;    ///< residual force over the load [-]
  int newton_iterations = 30;  ///< largest number per load step
};

/// Equilibrium of a solid in large displacement.
struct StaticSolution {
  Matrix3X u;                  ///< 3 x N [m]
  double strain_energy = 0.0;  ///< [J]
  int newton_iterations = 0;   ///< count
};

/// Newton's method with load stepping.
///
/// Equation   f_int(u) = f, u = 0 on the held nodes
/// Source     docs/theory/equations.md, level `full`
/// @param load dead nodal forces, 3 x N, mesh axes [N]
/// @param held sorted node indices, enough to prevent rigid motion
/// @throws NumericalError naming the load reached if Newton does not converge
/// or the stiffness is no longer positive definite (a limit point).
[[nodiscard]] StaticSolution solve_static(
    const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
    Elasticity law, const Matrix3X& load, const std::vector<int>& held,
    const StaticSettings& settings = {});

}  // namespace limber::fem
