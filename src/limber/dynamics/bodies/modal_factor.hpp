// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/dynamics/bodies/coupled_modes.hpp"
#include "limber/dynamics/bodies/link_end.hpp"
#include "limber/dynamics/bodies/tangent_coefficients.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// Fills BodyTerms::stiffness at a state, of bodies whose elasticity couples
/// their modes.
void calc_stiffness(const SystemModel& model, const SystemState& state,
                    SystemTerms& terms);

/// One reduced body's block D of NewtonMatrix, rows and columns translation
/// (world frame), rotation (body frame), modes: where elasticity is diagonal so
/// is its modal block, and D^-1 costs O(modes); else the block has a dense
/// factor, O(modes^3), and D^-1 costs O(modes^2).
///
/// Equation   D = [c m, 0, 0; 0, S, c H; 0, c H' T, c + v zeta + K],
///            K = diag(lambda) or BodyTerms::stiffness, plus lambda times
///            BodyTerms::maxwell_stiffness,
///            S = (c J + v (w x J - (J w) x)) T; c, v: derivatives of
///            acceleration and velocity at the step's end, T: of the step's
///            rotation; to a diagonal K TangentCoefficients::calming is added
class ModalFactor {
 public:
  explicit ModalFactor(const BodyModel& body);

  /// As BodyFactor.
  bool update(const SystemModel& model, std::size_t b, const SystemState& state,
              const SystemTerms& terms, const Matrix3& T,
              const TangentCoefficients& c, bool renews);
  [[nodiscard]] LinkEnd make_end(const SystemModel& model, std::size_t b) const;
  void renew_end(const SystemModel&, std::size_t, const SystemTerms&,
                 LinkEnd&) const {}
  void calc_rows(const SystemModel& model, std::size_t b,
                 const SystemState& state, const SystemTerms& terms,
                 const Matrix3& R_FW, LinkEnd& end) const;
  template <typename Finish>
  void solve_end(const SystemModel&, std::size_t, const SystemState&,
                 const Matrix3&, const Finish&, LinkEnd& end) const {
    solve_rows(end.G, end.Zt);
  }
  void solve(const SystemModel& model, std::size_t b, const SystemTerms&,
             VectorX& x) {
    solve(x.data() + model.bodies[b].row);
  }

  /// Rows of the result: D^-1 times the rows of G, each 6 + modes long.
  void solve_rows(const Matrix6X& G, Matrix6X& result) const;

  /// D itself, six rows and columns at a time, padded with the identity, which
  /// also replaces missing rigid motion.
  [[nodiscard]] Matrix6 block(int row, int column) const;
  [[nodiscard]] int block_count() const {
    return 1 + (static_cast<int>(coupling_.cols()) + 5) / 6;
  }

 private:
  void update_modes(const BodyModel& body, const BodyTerms& terms,
                    const TangentCoefficients& c);
  void solve(double* x);
  void solve_modes(Eigen::Ref<VectorX> x);
  void solve_coupled_rows(const Matrix6X& G, Matrix6X& result) const;
  [[nodiscard]] Matrix6 modal_block(int row, int column) const;

  double inverse_mass_ = 0.0;  // of the translation block, 0 if clamped
  Matrix3 rotation_ = Matrix3::Identity();      // S
  Matrix3 inverse_rotation_ = Matrix3::Zero();  // of the Schur complement
  Matrix3X coupling_;                           // c H
  Matrix3X back_coupling_;                      // (c H' T)'
  VectorX inverse_modes_;  // of a diagonal modal block, else none
  std::optional<CoupledModes> coupled_modes_;  // of a dense one
  VectorX diagonal_;                           // c + v zeta of that
  /// Modal block^-1 (c H' T): m x 3.
  Eigen::Matrix<double, Eigen::Dynamic, 3> answer_;
};

}  // namespace limber::dynamics
