// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

#include "limber/common/records/manifest.hpp"
#include "limber/common/types.hpp"

/// Functions that a kind of modal elasticity provides. A kind that lacks a
/// function does not compile.
namespace limber::flexbody {

/// m modal coordinates q [kg^1/2 m], read without a copy.
using ModesIn = Eigen::Ref<const VectorX>;
using ModesOut = Eigen::Ref<VectorX>;
using ModesSquare = Eigen::Ref<MatrixX>;  ///< m x m

/// Potential V(q) [J], force dV/dq [kg^-1/2 N] (that which resists q), and
/// tangent d^2V/dq^2 [rad^2/s^2], symmetric. No function allocates.
template <typename Kind>
concept HasPotential = requires(const Kind& kind, const ModesIn& q,
                                ModesOut force, ModesSquare tangent) {
  { kind.size() } -> std::same_as<Eigen::Index>;
  { kind.energy(q) } -> std::same_as<double>;
  kind.calc_force(q, force);
  kind.calc_tangent(q, tangent);
};

/// Discrete gradient: a force f(q0, q1), symmetric in both ends, with
/// f . (q1 - q0) = V(q1) - V(q0) exactly and f(q, q) = dV/dq. The tangent is
/// the derivative of 2 f by q1: d^2V/dq^2 where both ends are one; in general
/// not symmetric.
template <typename Kind>
concept HasDiscreteGradient = requires(const Kind& kind, const ModesIn& q0,
                                       const ModesIn& q1, ModesOut force,
                                       ModesSquare tangent) {
  kind.calc_force_over_step(q0, q1, force);
  kind.calc_tangent_over_step(q0, q1, tangent);
};

/// Properties on which algorithms may rely.
///
/// `eigenvalues`: m [rad^2/s^2] if modes are independent linear oscillators,
/// dV/dq_k = eigenvalue_k q_k, else null. Everything that takes each mode alone
/// (closed forms, advice on levels, factors of O(m)) needs them.
/// `is_linear`: the tangent is constant.
/// `rest_stiffness`: diagonal of the tangent at q = 0, and whether that is all
/// of it; `lowest_rest_stiffness` its smallest eigenvalue [rad^2/s^2].
template <typename Kind>
concept HasElasticTraits = requires(const Kind& kind) {
  { kind.eigenvalues() } -> std::same_as<const VectorX*>;
  { kind.is_linear() } -> std::same_as<bool>;
  { kind.rest_stiffness() } -> std::same_as<const VectorX&>;
  { kind.is_diagonal_at_rest() } -> std::same_as<bool>;
  { kind.lowest_rest_stiffness() } -> std::same_as<double>;
};

/// Its parameters name all that enters a run (common/records/fields.hpp).
template <typename Kind>
concept ModalElasticityKind = HasPotential<Kind> && HasDiscreteGradient<Kind> &&
    HasElasticTraits<Kind> && HasParameters<Kind>;

}  // namespace limber::flexbody
