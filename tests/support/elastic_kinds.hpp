// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_model.hpp"
#include "limber/flexbody/elasticity/modal_elasticity.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

/// Kinds of modal elasticity, made up for tests.
namespace limber::testing {

/// A random orthogonal matrix.
MatrixX make_basis(Eigen::Index size, unsigned seed);

/// The last `paired` modes are coupled: where they are all at `amplitude`
/// [kg^1/2 m], quadratic strains are about as large as linear ones.
flexbody::QuadraticStrain make_quadratic_strain(const VectorX& lambda,
                                                int paired, double amplitude,
                                                unsigned seed);

/// The same body in other modal coordinates, eta = U eta'. Its eigenvalues are
/// the diagonal of its stiffness, which turn_stiffness() has in full.
flexbody::ReducedBody turn_basis(const flexbody::ReducedBody& body,
                                 const MatrixX& U);
flexbody::InterfaceTable turn_basis(const flexbody::InterfaceTable& table,
                                    const MatrixX& U);
flexbody::FullStiffness turn_stiffness(const VectorX& lambda, const MatrixX& U);

/// Gives every flexible body of a system quadratic strains.
void stiffen(dynamics::SystemModel& model, double amplitude);

/// Lifts every flexible body of a system, and frames that its modes move, to
/// level nonlinear, with made-up second-order tables: where the modes but the
/// first are at `amplitude`, about as large as the linear ones.
void bend(dynamics::SystemModel& model, double amplitude);

/// A clamped body whose first mode is Duffing's oscillator, q'' + a q + b q^3 =
/// 0. Its second, without a stiffness of its own, rests.
struct Duffing {
  double a = 0.0;  ///< [rad^2/s^2]
  double b = 0.0;  ///< [kg^-1 m^-2 rad^2/s^2]

  [[nodiscard]] flexbody::QuadraticStrain elasticity() const;
  /// At rest at `amplitude`: closed form by Jacobi's cn.
  [[nodiscard]] double period(double amplitude) const;
  [[nodiscard]] double position(double amplitude, double t) const;
};

}  // namespace limber::testing
