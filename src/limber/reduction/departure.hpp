// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <vector>

#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/reduction/operating_states.hpp"

/// How a body departs from a static deformation when its loads change in time,
/// F(t) = sum_j alpha_j(t) F_j: docs/theory/operating_states.md
/// [@ligterink2005, sections 4 to 6]. Part of limber_reduction.
namespace limber::flexbody {

/// One input and one shape: x(t) = (alpha + beta) x_0.
///
/// Equation   m beta'' + d beta' + k beta = -m alpha'' - d alpha'
struct SingleInputModel {
  double m = 0.0;  ///< x_0^T M x_0 [kg m^2]
  double d = 0.0;  ///< x_0^T D x_0 [N m s]
  double k = 0.0;  ///< x_0^T K x_0 [N m]

  /// H of beta = H alpha: -(m s^2 + d s) / (m s^2 + d s + k), s in [1/s].
  [[nodiscard]] std::complex<double> calc_transfer(
      std::complex<double> s) const;
  /// m / k [s^2]: for slow changes beta = -(m / k) alpha'' - (d / k) alpha'.
  [[nodiscard]] double inertial_delay() const { return m / k; }
  /// d / k [s]: the delay of the deformation behind its load.
  [[nodiscard]] double frictional_delay() const { return d / k; }
};
/// @throws InputError for a state without deformation, and friction below zero.
[[nodiscard]] SingleInputModel make_single_input_model(
    const MeshedBody& body, const OperatingState& state,
    const Friction& friction = {});

/// Several inputs, each with its terms x_n = (K^+ M)^n x_0, projected so that
/// energy is conserved: Lagrange's equations in the span of all terms.
///
/// Equation   r'' + C r' + diag(lambda) r = Q alpha,  x = Phi r
struct DepartureModel {
  ReducedBasis basis;  ///< on the free nodes
  MatrixX C;           ///< Phi^T D Phi, m x m [1/s]
  MatrixX Q;           ///< Phi^T F, m x inputs [kg^-1/2 N]

  /// r at constant alpha = 1: the static response, m x inputs [kg^1/2 m].
  [[nodiscard]] MatrixX calc_static() const;
  /// r for alpha = e^(s t), m x inputs; s in [1/s].
  [[nodiscard]] Eigen::MatrixXcd calc_response(std::complex<double> s) const;
};
/// @param loads 3N x inputs on all nodes, mesh frame [N]; for a free body the
///        part of rigid acceleration is removed
/// @param terms >= 1, of each input
/// @throws InputError for a load without deformation, values that are not
/// finite, terms below 1 and friction below zero.
[[nodiscard]] DepartureModel make_departure_model(
    const MeshedBody& body, const MatrixX& loads, int terms,
    const Friction& friction = {});

/// Models of loads that act one after another. Each also spans the first terms
/// of the previous load, whose vibration continues.
///
/// Source     [@ligterink2005, section 6.1]
/// @param loads 3N x intervals, as make_departure_model's
/// @param carried >= 0, terms kept of the previous load
[[nodiscard]] std::vector<DepartureModel> make_interval_models(
    const MeshedBody& body, const MatrixX& loads, int terms, int carried,
    const Friction& friction = {});

/// State of a model.
struct DepartureMotion {
  VectorX r;     ///< [kg^1/2 m]
  VectorX rdot;  ///< [kg^1/2 m/s]
};
/// A motion projected on another model: nearest in elastic energy, its rate
/// nearest in kinetic energy. Never gains energy.
struct CarriedMotion {
  DepartureMotion motion;
  double lost = 0.0;  ///< energy outside the new model [J]
};
[[nodiscard]] CarriedMotion carry_motion(const MeshedBody& body,
                                         const DepartureModel& from,
                                         const DepartureModel& to,
                                         const DepartureMotion& motion);

}  // namespace limber::flexbody
