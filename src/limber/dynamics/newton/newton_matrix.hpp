// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "limber/dynamics/bodies/body_factor.hpp"
#include "limber/dynamics/newton/lu_plan.hpp"
#include "limber/dynamics/newton/pair_tangents.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// Factors of the Newton matrix of one implicit step.
///
/// Equation   D_b x_b - sum_c G_cb' dw_c = -r_b          (each body b)
///            dw_c = s_c - K_c sum_b G_cb x_b            (each coupler c)
///            D_b: inertia, damping and elasticity of one body; where that is
///            diagonal its modal block is, too, so D_b^-1 costs O(m), else
///            it is dense (ModalFactor); of an unreduced body
///            it is Q (c M + K(u)) Q', sparse, with Q the rotation of its nodes
///            with the body, so that its factors remain valid under large
///            rotation. G_cb: the coupler's relative motion per body increment.
///            K_c: its stiffness plus damping. s_c: the law's wrench less the
///            acting iterate. Eliminating x_b leaves six unknowns a coupler, (I
///            + K G D^-1 G') dw = s + K G D^-1 r, with the coupler graph's
///            pattern. As K grows this tends to the constrained system with its
///            multipliers, so that any stiffness is admissible: the huge wrench
///            of a law at an unconverged configuration never acts. A body with
///            so many couplers that their dense block would be larger than the
///            body's, a retained body, is not eliminated: its increments are
///            additional unknowns, with K_c G_cb x_b in the couplers' rows and
///            its own equation as a row; those of a retained body that shares
///            couplers with another are relative to it (RetainedTransports). So
///            are, before all couplers, bodies of pairs that have points: their
///            tangent (PairTangents) joins both bodies' blocks. A transmission
///            is a coupler with any number of ends and one unknown, the first
///            of six; its other five rows are the identity. In constrained
///            directions of an ideal joint that limit itself is the row,
///            0 = s_c - sum_b G_cb x_b with minus the deflection as s_c.
/// Source     docs/decisions, "Coupler wrenches as Newton's unknowns".
/// Limits     neglects what ResidualDerivative adds: geometric stiffness of
///            couplers and loads, and derivatives of inertial forces by modes
///            and, for modes, by velocities. This costs iterations, not
///            accuracy.
///
/// Increments x_b: translation in the world frame [m] (so that reused factors,
/// too, transmit equal and opposite forces), rotation in the body frame [rad],
/// modal coordinates; body b starts at 6 b + body.offset. Then the nodes of
/// unreduced bodies, home frame [m].
class NewtonMatrix {
 public:
  NewtonMatrix() = default;
  explicit NewtonMatrix(const SystemModel& model);

  using Coefficients = TangentCoefficients;

  /// Factors at the evaluated `terms`; `motion` is the step's, whose rotations
  /// count [rad]. Unreduced bodies keep their sparse factors, in the
  /// body frame, until the acceleration coefficient changes or `renews_all` is
  /// set.
  /// @throws NumericalError naming the coupler or body.
  /// @param end_terms where couplers are evaluated, if wrenches act elsewhere,
  /// at `terms` (no bodies at level `full` then); the step's rotations are then
  /// those of Cayley's transform, and BodyTerms::stiffness is that of `terms`
  void factor(const SystemModel& model, const SystemState& state,
              SystemTerms& terms, const VectorX& motion,
              const Coefficients& coefficients, bool renews_all = false,
              const SystemTerms* end_terms = nullptr);

  /// Increments for a residual: solves with -r (sizes 6 bodies + modes) and
  /// the couplers' s. The wrench increments are then in wrench_increments().
  void solve(const SystemModel& model, const SystemTerms& terms,
             const VectorX& residual, VectorX& increments);
  /// The same for any s, one per coupler, then one per transmission, in the
  /// first entry.
  void solve(const SystemModel& model, const SystemTerms& terms,
             const VectorX& residual, const std::vector<Vector6>& gaps,
             VectorX& increments);

  /// Whether pairs have as many points at `terms` as at the last factors.
  [[nodiscard]] bool knows_pairs(const SystemTerms& terms) const {
    return pairs_.knows(terms);
  }

  /// Number of solves since the last call.
  [[nodiscard]] long take_solves() { return std::exchange(solves_, 0); }

  /// The law's wrench less the acting one, minus the deflection in constrained
  /// directions of an ideal joint: s of the equation.
  [[nodiscard]] static Vector6 find_gap(const SystemTerms& terms,
                                        std::size_t link);

  /// Of the last solve, one per coupler [N, N m], then one per transmission,
  /// whose force is the first entry.
  [[nodiscard]] const std::vector<Vector6>& wrench_increments() const {
    return wrenches_;
  }

  /// Change of the laws by increments at the last factors: -K_c G x, six a
  /// coupler, then one per transmission.
  void find_wrench_changes(const SystemTerms& terms, const VectorX& increments,
                           VectorX& changes) const;

 private:
  // One end of a coupler or transmission on a moving body.
  struct End : LinkEnd {
    int link = 0;            // couplers first, then transmissions
    CouplerIndex coupler{};  // in whose frame F it is expressed; none: world
    int term = -1;           // of a transmission's coordinate
    BodyIndex body{};
    bool is_M = true;
    // G D^-1 G' of a body that precedes the links, about; Zt of a retained one
    // is G at the acting wrench.
    Matrix6 compliance = Matrix6::Zero();
  };

  void add_end(const SystemModel& model, int link, CouplerIndex coupler,
               int term, AttachmentIndex attachment, bool is_M);
  void factor_end(const SystemModel& model, const SystemState& state,
                  const SystemTerms& terms, End& end) const;
  [[nodiscard]] Matrix3 find_R_FW(const SystemModel& model,
                                  const SystemTerms& terms,
                                  const End& end) const;
  void finish_rows(const SystemTerms& terms, const End& end,
                   Matrix6X& rows) const;
  // Sets G of an end.
  void calc_rows(const SystemModel& model, const SystemState& state,
                 const SystemTerms& terms, End& end) const;
  void finish_graph(const SystemModel& model);
  [[nodiscard]] bool is_retained(const End& end) const {
    return plan_.retained_of_body[static_cast<std::size_t>(end.body)] >= 0;
  }
  [[nodiscard]] Vector6 rotate_gap(const SystemTerms& terms, std::size_t link,
                                   const Vector6& gap) const;
  void assemble(const SystemModel& model, const SystemTerms& terms,
                const SystemTerms& end_terms, const Coefficients& c);
  [[nodiscard]] Pose find_pose(const SystemTerms& terms, int body) const;
  void add_compliances(const RetainedUnknowns& retained);
  void assemble_retained(const RetainedUnknowns& retained);
  [[nodiscard]] std::string describe_singular(const SystemModel& model,
                                              const SystemTerms& terms,
                                              int row) const;

  std::vector<BodyFactor> bodies_;
  std::vector<End> ends_;
  std::vector<std::vector<int>> ends_of_body_;
  std::size_t couplers_ = 0;
  std::vector<Matrix6> rows_;              // T: rotated and scaled, per link
  std::vector<Vector6> yields_;            // E, on the rows of T
  std::vector<Matrix6> scaled_stiffness_;  // T K
  std::vector<Vector6> wrenches_;
  std::vector<Vector6> gaps_;
  LinkGraph graph_;
  LuPlan plan_;
  PairTangents pairs_;
  std::vector<Matrix6>
      compliances_;                // of links by bodies that precede the links
  std::vector<Vector6> unknowns_;  // of plan_
  long solves_ = 0;
};

}  // namespace limber::dynamics
