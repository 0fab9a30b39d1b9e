// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/workspace.hpp"

namespace limber::dynamics {

/// Factors of an unreduced body's block of the Newton matrix. They are made in
/// body axes, so that they outlast large rotation and serve many steps.
///
/// Equation   D = Q (c_a M + K(u_B) + c_v M Phi C Phi' M) Q', Q turns each node
///            by R_HB. With U = M Phi and V = (c_a M + K)^-1 U, the few damped
///            modes are added as (D_0 + U C U')^-1 = D_0^-1 - V (1 + C U' V)^-1
///            C U' D_0^-1.
class FullFactor {
 public:
  /// Coefficients of acceleration [1/s^2] and velocity [1/s].
  struct Coefficients {
    double acceleration = 0.0;
    double velocity = 0.0;
  };

  /// Takes the state's R_HB; makes new factors if the coefficients changed or
  /// `renews`. @returns whether it did.
  /// @throws NumericalError naming the body and the time.
  bool update(const SystemModel& model, std::size_t f, const SystemState& state,
              SystemTerms& terms, const Coefficients& c, bool renews);

  /// x <- D^-1 x, home axes.
  void solve(const FullModel& full, const flexbody::FullBodySolver& solver,
             Eigen::Ref<VectorX> x_H) const;
  /// The same for columns in body axes.
  void solve_columns(const FullModel& full,
                     const flexbody::FullBodySolver& solver,
                     Eigen::Ref<MatrixX> x_B) const;

  [[nodiscard]] const Matrix3& R_HB() const { return R_HB_; }

 private:
  void add_damping(const FullModel& full,
                   const flexbody::FullBodySolver& solver, double velocity);

  double acceleration_ = 0.0;           // of the sparse factors, 0: none
  Matrix3 R_HB_ = Matrix3::Identity();  // at the last update
  MatrixX V_;  // 3N x m: V (1 + C U' V)^-1 C; no columns if undamped
};

}  // namespace limber::dynamics
