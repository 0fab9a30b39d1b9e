// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "dynamics/block_lu.hpp"
#include "dynamics/body_factor.hpp"
#include "dynamics/full_factor.hpp"
#include "dynamics/workspace.hpp"

namespace limber::dynamics {

/// Factors of the Newton matrix of one implicit step.
///
/// Equation   D_b x_b - sum_c G_cb' dw_c = -r_b          (each body b)
///            dw_c = s_c - K_c sum_b G_cb x_b            (each coupler c)
///            D_b: inertia, damping and elasticity of one body; its modal
///            block is diagonal, so D_b^-1 costs O(m); of an unreduced body
///            it is Q (c M + K(u)) Q', sparse, with the Q that turns its
///            nodes with the body, so that its factors outlast large
///            rotation. G_cb: the coupler's
///            relative motion per body increment. K_c: its stiffness plus
///            damping. s_c: the law's wrench less the iterate that acts.
///            Eliminating x_b leaves six unknowns a coupler,
///            (I + K G D^-1 G') dw = s + K G D^-1 r, with the coupler graph's
///            pattern. As K grows this tends to the constrained system with
///            its multipliers, so no stiffness is too stiff: the huge wrench
///            of a law at a configuration that has not converged never acts.
///            A body that so many couplers hold that they would be a larger
///            dense block than the body, a hub, is not eliminated: its
///            increments are unknowns besides, K_c G_cb x_b stands in the
///            couplers' rows and its own equation is a row.
///            A transmission is a coupler of any number of ends and one
///            unknown, the first of six; its other five rows are the identity.
/// Source     docs/decisions, "Coupler wrenches as Newton's unknowns".
/// Limits     leaves out what ResidualDerivative adds: geometric stiffness of
///            couplers and loads, and derivatives of inertial forces by modes
///            and, for modes, by velocities. They cost iterations, never
///            accuracy.
///
/// Increments x_b: translation in world axes [m] (so that old factors, too,
/// pass equal and opposite forces on), rotation in body axes [rad], modal
/// coordinates; body b starts at 6 b + body.offset. Behind all of them, the
/// nodes of unreduced bodies, home axes [m].
class NewtonMatrix {
 public:
  NewtonMatrix() = default;
  explicit NewtonMatrix(const SystemModel& model);

  /// Derivatives of a step's end: acceleration [1/s^2] and velocity [1/s] per
  /// increment.
  using Coefficients = FullFactor::Coefficients;

  /// Factors at the evaluated `terms`; `rotation_increments` are the step's,
  /// one a body [rad]. Unreduced bodies keep their sparse factors, in body
  /// axes, until the acceleration coefficient changes or `renews_full` asks for
  /// new ones. @throws NumericalError naming the coupler or body.
  /// @param end_terms where couplers see the increments, if wrenches do not act
  /// there but at `terms` (no bodies at level `full` then); rotation increments
  /// are then those of Cayley's transform
  void factor(const SystemModel& model, const SystemState& state,
              SystemTerms& terms,
              const std::vector<Vector3>& rotation_increments,
              const Coefficients& coefficients, bool renews_full = false,
              const SystemTerms* end_terms = nullptr);

  /// Increments for a residual: solves with -r (sizes 6 bodies + modes) and
  /// the couplers' s. The wrench increments are then in wrench_increments().
  void solve(const SystemModel& model, const SystemTerms& terms,
             const VectorX& residual, VectorX& increments);
  /// The same for any s, one a coupler, then one a transmission, in the first
  /// entry.
  void solve(const SystemModel& model, const SystemTerms& terms,
             const VectorX& residual, const std::vector<Vector6>& gaps,
             VectorX& increments);

  /// How many solves there were since this was asked last.
  [[nodiscard]] long take_solves() { return std::exchange(solves_, 0); }

  /// The law's wrench less the one that acts: s of the equation.
  [[nodiscard]] static Vector6 find_gap(const SystemTerms& terms,
                                        std::size_t link);

  /// Of the last solve, one a coupler [N, N m], then one a transmission, whose
  /// force is the first entry.
  [[nodiscard]] const std::vector<Vector6>& wrench_increments() const {
    return wrenches_;
  }

  /// What increments change of the laws at the last factors: -K_c G x, six a
  /// coupler, then one a transmission.
  void find_wrench_changes(const SystemTerms& terms, const VectorX& increments,
                           VectorX& changes) const;

  [[nodiscard]] static Eigen::Index size(const SystemModel& model) {
    return first_node_row(model) + model.nodal_count;
  }
  [[nodiscard]] static Eigen::Index first_node_row(const SystemModel& model) {
    return 6 * static_cast<Eigen::Index>(model.bodies.size()) +
           model.modal_count;
  }

 private:
  // One end of a coupler or transmission on a body that moves.
  struct End {
    int link = 0;      // of a coupler; transmissions count on
    int coupler = -1;  // in whose axes F it is told, -1: the world's
    int term = -1;     // of a transmission's coordinate
    int attachment = 0;
    int body = 0;
    bool is_M = true;
    Eigen::Index row = 0;  // the body's first
    Matrix6X G;            // 6 x (6 + m), or 6 x 3N
    Matrix6X Zt;           // (D^-1 G')'; of a hub G where its wrench acts
    Matrix6X Zt_B;         // of an unreduced body, both in body axes
  };

  // A body whose increments are unknowns of lu_.
  struct Hub {
    int body = 0;
    int first = 0;  // its first row of lu_
    int blocks = 0;
    int size = 0;  // rigid motion and modes
  };

  void add_end(const SystemModel& model, int link, int coupler, int term,
               int attachment, bool is_M);
  void factor_full(const SystemModel& model, const SystemState& state,
                   SystemTerms& terms, const Coefficients& c, bool renews);
  void factor_end(const SystemModel& model, const SystemState& state,
                  const SystemTerms& terms, End& end) const;
  [[nodiscard]] Matrix3 find_R_FW(const SystemModel& model,
                                  const SystemTerms& terms,
                                  const End& end) const;
  void finish_rows(const SystemTerms& terms, const End& end,
                   Matrix6X& rows) const;
  // G of an end on a reduced body.
  void calc_modal_rows(const SystemModel& model, const SystemTerms& terms,
                       End& end) const;
  void plan_lu(const SystemModel& model, int links);
  [[nodiscard]] bool is_on_hub(const End& end) const {
    return hub_of_body_[static_cast<std::size_t>(end.body)] >= 0;
  }
  void assemble(const SystemTerms& terms, const Coefficients& c);
  void assemble_hub(const Hub& hub);
  [[nodiscard]] std::string describe_singular(const SystemModel& model,
                                              const SystemTerms& terms,
                                              int row) const;

  std::vector<BodyFactor> bodies_;
  std::vector<FullFactor> full_;
  std::vector<End> ends_;
  std::vector<std::vector<int>> ends_of_body_;
  std::vector<Hub> hubs_;
  std::vector<int> hub_of_body_;  // -1: none
  std::size_t couplers_ = 0;
  std::vector<Matrix6> rows_;              // T: turned and scaled, per link
  std::vector<Matrix6> scaled_stiffness_;  // T K
  std::vector<Vector6> wrenches_;
  std::vector<Vector6> gaps_;
  BlockLu lu_;
  std::vector<Vector6> unknowns_;  // of lu_: a link each, then hubs
  long solves_ = 0;
};

}  // namespace limber::dynamics
