// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/bodies/link_end.hpp"
#include "limber/dynamics/bodies/tangent_coefficients.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

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
class NodalFactor {
 public:
  /// As BodyFactor; takes the state's R_HB, and refactors if the coefficients
  /// changed or if `renews`.
  /// @throws NumericalError naming the body and the time.
  bool update(const SystemModel& model, std::size_t b, const SystemState& state,
              SystemTerms& terms, const Matrix3& T,
              const TangentCoefficients& c, bool renews);
  [[nodiscard]] LinkEnd make_end(const SystemModel& model, std::size_t b) const;
  void renew_end(const SystemModel& model, std::size_t b,
                 const SystemTerms& terms, LinkEnd& end) const;
  void calc_rows(const SystemModel& model, std::size_t b,
                 const SystemState& state, const SystemTerms& terms,
                 const Matrix3& R_FW, LinkEnd& end) const;
  template <typename Finish>
  void solve_end(const SystemModel& model, std::size_t b,
                 const SystemState& state, const Matrix3& R_FW,
                 const Finish& finish, LinkEnd& end) const {
    rotate_answers(model, b, state, R_FW, end);
    finish(end.Zt);
  }
  void solve(const SystemModel& model, std::size_t b, const SystemTerms& terms,
             VectorX& x) const;
  [[nodiscard]] int block_count() const { return 0; }

 private:
  // Sets Zt to the frame's answers, in F.
  void rotate_answers(const SystemModel& model, std::size_t b,
                      const SystemState& state, const Matrix3& R_FW,
                      LinkEnd& end) const;
  // x <- D^-1 x for columns in the body frame.
  void solve_columns(const FullModel& full,
                     const flexbody::FullBodySolver& solver,
                     Eigen::Ref<MatrixX> x_B) const;
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
