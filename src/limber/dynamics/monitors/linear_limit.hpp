// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/displacement_measure.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Fraction of the undeformed body's stiffness that rotation cancels, in linear
/// elasticity.
///
/// Equation   largest eigenvalue mu of Lambda^-1/2 B Lambda^-1/2, with
///            B_kl = 1/2 w' (d^2 J / d eta_k d eta_l) w: the effective
///            stiffness is Lambda - B, the critical speed |w| / sqrt(mu)
/// Source     equations of motion of level `coupled`; linear theory neglects
///            stress stiffening, which prevents the instability [@shabana2013,
///            ch. 5]
/// @param w_WB_B [rad/s]
/// @returns mu [-]; 0 at levels without B, and below half the lowest frequency,
/// where it cannot reach 1
[[nodiscard]] double find_softening(const BodyModel& body,
                                    const Vector3& w_WB_B);

/// Monitors deformations: linear elasticity is valid for small ones only. It
/// evaluates every step, so its result does not depend on the outputs.
///
/// Equation   displacements and fractions of stiffness are computed where a
/// bound
///            on their change since the last time does not exclude a finding:
///            |u(eta)| <= |u(eta_0)| + sum_k size_k |eta - eta_0|_k and
///            mu(q) <= mu(q_0) + sum_i mu(e_i) |q - q_0|_i of q = w' w / 2
/// Limits     only for reduced bodies with stored nodes; looks at the ends of
///            steps
class LinearLimit {
 public:
  explicit LinearLimit(const SystemModel& model);

  /// The end of a step. Adds a warning, once per body, if its deformation
  /// exceeds 10 % of its longest edge, or its spin the critical speed of linear
  /// elasticity; at level nonlinear if an interface rotates by more than 0.4
  /// rad.
  /// @throws NumericalError naming the body, the dominant mode and the time if
  /// the deformation exceeds 100 %, which is not a valid result.
  void check(const SystemState& state, std::vector<std::string>& warnings);

  /// Saves or restores which bodies were warned about, for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  struct Body {
    std::size_t index = 0;
    double size = 0.0;             // longest edge, 0: unknown [m]
    double harmless_square = 0.0;  // of its spin [rad^2/s^2]
    DisplacementMeasure measure;
    std::optional<Vector6> unit_fractions = {};  // if needed yet [s^2/rad^2]
    bool was_reported_large = false;
    bool was_reported_soft = false;
    // The last ones that were computed.
    VectorX eta = {};
    double displacement = 0.0;           // [m]
    Vector6 products = Vector6::Zero();  // half_square(w) [rad^2/s^2]
    double softening = 0.0;
  };
  [[nodiscard]] bool may_exceed(const SystemState& state, Body& body,
                                double limit) const;
  [[nodiscard]] bool may_soften(const SystemState& state, Body& body) const;
  void check_deformation(const SystemState& state, Body& body,
                         std::vector<std::string>& warnings) const;
  void check_speed(const SystemState& state, Body& body,
                   std::vector<std::string>& warnings) const;

  const SystemModel& model_;
  std::vector<Body> bodies_;
};

/// Warning about a body that spins too fast; nothing if it does not.
[[nodiscard]] std::optional<std::string> describe_softening(
    const BodyModel& body, const Vector3& w_WB_B);

/// Warning about a body at level nonlinear, an interface of which has rotated
/// by more than 0.4 rad; nothing if none has.
[[nodiscard]] std::optional<std::string> describe_large_rotation(
    const SystemModel& model, const SystemState& state, std::size_t body);

}  // namespace limber::dynamics
