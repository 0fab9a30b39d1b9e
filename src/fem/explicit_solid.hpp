// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "fem/nodal_mass.hpp"
#include "fem/nonlinear_solid.hpp"

namespace limber::fem {

/// Motion of all nodes of a mesh, mesh axes.
struct SolidState {
  double t = 0.0;  ///< [s]
  Matrix3X u;      ///< 3 x N displacement [m]
  Matrix3X v;      ///< 3 x N velocity [m/s]
};

/// Fills nodal forces, 3 x N [N], at a time [s].
using NodalForces = std::function<void(double t, Matrix3X& force)>;

/// Central differences (velocity Verlet) for a free solid.
///
/// Equation   v+ = v + h/2 a;  u <- u + h v+;  M a = f_ext - f_int(u);
///            v <- v+ + h/2 a
/// Source     [@belytschko2000, sec. 6.2]. Second order, symplectic: linear and
///            angular momentum are kept to round-off.
/// Limits     stable below estimate_stable_step
class ExplicitSolid {
 public:
  ExplicitSolid(const NonlinearSolid& solid, const NodalMass& mass,
                NodalForces forces);

  /// Takes the accelerations from `state`; before the first step, and after
  /// a jump of the forces.
  void start(const SolidState& state);
  /// Advances by h to the time `end` [s]. @throws NumericalError for an
  /// element inside out; `state` is then that before the step.
  void step(SolidState& state, double h, double end);

  [[nodiscard]] double strain_energy() const {
    return strain_energy_;
  }                                                                    ///< [J]
  [[nodiscard]] double kinetic_energy(const SolidState& state) const;  ///< [J]

 private:
  void accelerate(double t, const Matrix3X& u);

  const NonlinearSolid& solid_;
  const NodalMass& mass_;
  NodalForces forces_;
  NonlinearSolid::Workspace workspace_;
  Matrix3X internal_, external_, a_;
  SolidState next_;
  double strain_energy_ = 0.0;
};

/// Longest stable step of central differences about the undeformed state [s]:
/// 2 / omega_max, omega_max by power iteration on M^-1 K to a thousandth.
/// @param K_lower 3N x 3N stiffness, lower triangle
[[nodiscard]] double estimate_stable_step(const SparseMatrix& K_lower,
                                          const NodalMass& mass);

}  // namespace limber::fem
