// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/equations/workspace.hpp"

namespace limber::dynamics {

/// Factors of an unreduced body's block of the Newton matrix. They are made in
/// the body frame, so that they remain valid under large rotation and serve
/// many steps.
///
/// Equation   D = Q (c_a M + K(u_B) + c_v M Phi C Phi' M) Q', Q rotates
///            each node by R_HB. With U = M Phi and V = (c_a M + K)^-1 U, the
///            few damped modes are added as (D_0 + U C U')^-1 = D_0^-1 - V (1 +
///            C U' V)^-1 C U' D_0^-1. Where c_a M is round-off of K, rigid
///            motion R (R' M R = 1, K R about 0) is separated: D_0^-1 is then P
///            (c M + K)^-1 P' + R R' / c_a with P = 1 - R R' M and a c that
///            keeps the factors regular; the same where stress makes c_a M + K
///            indefinite.
class FullFactor {
 public:
  /// Coefficients of acceleration [1/s^2] and velocity [1/s].
  struct Coefficients {
    double acceleration = 0.0;  ///< [1/s^2]
    double velocity = 0.0;      ///< [1/s]
    /// Of all modes, what numerical damping adds to the diagonal of those whose
    /// elasticity is diagonal; null: nothing [1/s^2].
    const VectorX* calming = nullptr;
  };

  /// Takes the state's R_HB; refactors if the coefficients changed or if
  /// `renews`. @returns whether it did.
  /// @throws NumericalError naming the body and the time.
  bool update(const SystemModel& model, std::size_t f, const SystemState& state,
              SystemTerms& terms, const Coefficients& c, bool renews);

  /// x <- D^-1 x, home frame.
  void solve(const FullModel& full, const flexbody::FullBodySolver& solver,
             Eigen::Ref<VectorX> x_H) const;
  /// The same for columns in the body frame.
  void solve_columns(const FullModel& full,
                     const flexbody::FullBodySolver& solver,
                     Eigen::Ref<MatrixX> x_B) const;

  [[nodiscard]] const Matrix3& R_HB() const { return R_HB_; }

 private:
  // @returns the c of its factors: `shift`, or a value that keeps them regular
  double factor_free(const FullModel& full, flexbody::FullBodySolver& solver,
                     const Matrix3X& u_B, double shift);
  void set_rigid_motion(const FullModel& full,
                        const flexbody::FullBodySolver& solver,
                        const Matrix3X& u_B);
  void add_damping(const FullModel& full,
                   const flexbody::FullBodySolver& solver, double velocity);
  void solve_undamped(const flexbody::FullBodySolver& solver,
                      Eigen::Ref<MatrixX> x_B) const;

  double acceleration_ = 0.0;           // of the sparse factors, 0: none
  double stiffness_ = 0.0;              // of K to M, 0: unknown yet [1/s^2]
  Matrix3 R_HB_ = Matrix3::Identity();  // at the last update
  MatrixX rigid_;          // 3N x 6: R; no columns if not separated
  MatrixX rigid_momenta_;  // M R
  MatrixX V_;  // 3N x m: V (1 + C U' V)^-1 C; no columns if undamped
};

}  // namespace limber::dynamics
