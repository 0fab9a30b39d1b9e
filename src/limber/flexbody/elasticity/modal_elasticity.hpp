// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "limber/flexbody/elasticity/diagonal_stiffness.hpp"
#include "limber/flexbody/elasticity/full_stiffness.hpp"
#include "limber/flexbody/elasticity/quadratic_strain.hpp"

/// Dispatch over all kinds of modal elasticity: other code calls these
/// functions, which call the kind's own (modal_elasticity_kind.hpp).
namespace limber::flexbody {

/// Elasticity of a body's modes. A new kind is added here and in the contract
/// tests of kinds of elasticity; see docs/decisions, "Elasticity of a body's
/// modes".
using ModalElasticity =
    std::variant<DiagonalStiffness, FullStiffness, QuadraticStrain>;

/// Number of modes.
[[nodiscard]] Eigen::Index count_modes(const ModalElasticity& elasticity);

/// @param q modal coordinates [kg^1/2 m] @returns [J]
[[nodiscard]] double calc_elastic_energy(const ModalElasticity& elasticity,
                                         const ModesIn& q);
/// @param force set to dV/dq [kg^-1/2 N]
void calc_elastic_force(const ModalElasticity& elasticity, const ModesIn& q,
                        ModesOut force);
/// @param tangent set to d^2V/dq^2 [rad^2/s^2]
void calc_elastic_tangent(const ModalElasticity& elasticity, const ModesIn& q,
                          ModesSquare tangent);

/// Discrete gradient from q0 to q1, and the derivative of twice that by q1.
void calc_elastic_force_over_step(const ModalElasticity& elasticity,
                                  const ModesIn& q0, const ModesIn& q1,
                                  ModesOut force);
void calc_elastic_tangent_over_step(const ModalElasticity& elasticity,
                                    const ModesIn& q0, const ModesIn& q1,
                                    ModesSquare tangent);

/// Eigenvalues, if modes are independent linear oscillators [rad^2/s^2]; else
/// null.
[[nodiscard]] const VectorX* find_eigenvalues(
    const ModalElasticity& elasticity);
[[nodiscard]] inline bool is_diagonal(const ModalElasticity& elasticity) {
  return find_eigenvalues(elasticity) != nullptr;
}
/// Whether the tangent is constant.
[[nodiscard]] bool is_linear(const ModalElasticity& elasticity);
/// Diagonal of the tangent of the undeformed body [rad^2/s^2].
[[nodiscard]] const VectorX& rest_stiffness(const ModalElasticity& elasticity);
/// Whether that is all of the tangent there.
[[nodiscard]] bool is_diagonal_at_rest(const ModalElasticity& elasticity);
/// Smallest eigenvalue of the tangent there [rad^2/s^2].
[[nodiscard]] double lowest_rest_stiffness(const ModalElasticity& elasticity);

}  // namespace limber::flexbody
