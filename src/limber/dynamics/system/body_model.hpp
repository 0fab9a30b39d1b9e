// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// Packs inertia shape integrals for the inner loops:
/// J(eta) = tr(S) I - S with S = S0 + S1 eta + (S1 eta)' + S2 eta eta, and
/// beta_kl = int phi_k x phi_l dm.
/// Source     design of the floating frame in docs/theory/equations.md.
[[nodiscard]] ModalInertia pack_inertia(
    const flexbody::InertiaShapeIntegrals& s);

/// The same with the second-order terms of level nonlinear.
///
/// Equation   S2_kl + sym(int x theta_kl' dm), for k, l in P
[[nodiscard]] ModalInertia pack_inertia(
    const flexbody::InertiaShapeIntegrals& s,
    const flexbody::QuadraticManifold& manifold);

/// Whether the modes' part of Newton's matrix is dense: elasticity that couples
/// modes, or forces on interfaces at level nonlinear.
[[nodiscard]] inline bool has_dense_modes(const BodyModel& body) {
  return body.fidelity == Fidelity::nonlinear ||
         !flexbody::is_diagonal(body.elasticity);
}

/// Whether rotation acts on a body's modes, but not they on it.
[[nodiscard]] inline bool is_one_way(const BodyModel& body) {
  return body.fidelity == Fidelity::one_way;
}

/// Whether a body's motion is of second order in its modes.
[[nodiscard]] inline bool is_quadratic(const BodyModel& body) {
  return body.fidelity == Fidelity::nonlinear;
}

/// Modes whose products move a body's points at level nonlinear, increasing
/// (flexbody/model/mode_products.hpp); else none.
[[nodiscard]] inline const std::vector<int>& paired_of(const BodyModel& body) {
  static const std::vector<int> none;
  const bool has_products = body.fidelity == Fidelity::nonlinear &&
                            body.reduced && body.reduced->manifold;
  return has_products ? body.reduced->manifold->paired : none;
}

/// Modes and products: columns of tables of points and of nodal loads.
[[nodiscard]] inline int count_coordinates(const BodyModel& body) {
  const Eigen::Index paired = std::ssize(paired_of(body));
  return body.modes + static_cast<int>(flexbody::count_pairs(paired));
}

/// Coordinates of a body in joints::PairBody: its modes, then at level
/// nonlinear their products; of an unreduced one 3N + 1; of the world none.
[[nodiscard]] int count_pair_coordinates(const SystemModel& model,
                                         BodyIndex body);

/// Eigenvalues of a body's modes [rad^2/s^2].
/// @param work what needs uncoupled modes, such as "advice on levels"
/// @throws InputError naming the body if its elasticity couples them.
[[nodiscard]] const VectorX& require_eigenvalues(const BodyModel& body,
                                                 std::string_view work);

/// Symmetric matrix of the components (xx, yy, zz, xy, xz, yz).
[[nodiscard]] inline Matrix3 unpack_symmetric(const Vector6& c) {
  Matrix3 m;
  m << c[0], c[3], c[4], c[3], c[1], c[5], c[4], c[5], c[2];
  return m;
}

/// Components of the quadratic form: w' A w / 2 = half_square(w) . pack(A).
[[nodiscard]] inline Vector6 half_square(const Vector3& w) {
  Vector6 q;
  q << 0.5 * w[0] * w[0], 0.5 * w[1] * w[1], 0.5 * w[2] * w[2], w[0] * w[1],
      w[0] * w[2], w[1] * w[2];
  return q;
}

}  // namespace limber::dynamics
