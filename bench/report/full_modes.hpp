// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/solid/matrices.hpp"

namespace limber::bench {

/// Every elastic mode of the beam of 579 nodes, by a dense solver: the total
/// in the report's percentages, and the truth that few modes are held to.
struct FullModes {
  fem::Mesh mesh;
  std::vector<int> nodes;            ///< those that move
  Matrix3X x;                        ///< 3 x n, of these [m]
  fem::StructuralMatrices matrices;  ///< of these
  VectorX lambda;                    ///< ascending [rad^2/s^2]
  MatrixX Phi;                       ///< 3n x m [kg^-1/2]
};

[[nodiscard]] FullModes find_full_modes(bool is_clamped);

/// The same force [N] on each moving node at these places, 3n.
[[nodiscard]] VectorX load_edge(const FullModes& modes, double x, double z,
                                const Vector3& force);

}  // namespace limber::bench
