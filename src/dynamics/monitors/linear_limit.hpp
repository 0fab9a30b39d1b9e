// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "dynamics/displacement_measure.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// How much of its stiffness rotation takes from a body, in linear elasticity.
///
/// Equation   largest eigenvalue mu of Lambda^-1/2 B Lambda^-1/2, with
///            B_kl = 1/2 w' (d^2 J / d eta_k d eta_l) w: the effective
///            stiffness is Lambda - B, the critical speed |w| / sqrt(mu)
/// Source     equations of motion of level `coupled`; linear theory has no
///            stress stiffening, which would save the body [@shabana2013, ch.
///            5]
/// @param w_WB_B [rad/s]
/// @returns mu [-]; 0 at levels that do not have B, and below half the lowest
/// frequency, where it cannot reach 1
[[nodiscard]] double find_softening(const BodyModel& body,
                                    const Vector3& w_WB_B);

/// Watches how far bodies are deformed: linear elasticity speaks of small
/// deformations.
///
/// Limits     looks at reduced bodies with kept nodes alone
class LinearLimit {
 public:
  explicit LinearLimit(const SystemModel& model);

  /// Adds a warning, once a body, if its deformation is beyond 10 % of its
  /// longest edge, or if it turns faster than linear elasticity can hold it.
  /// @throws NumericalError naming the body, the mode that counts most and the
  /// time if the deformation is beyond 100 %: no result any more.
  void check(const SystemState& state, std::vector<std::string>& warnings);

  /// Which bodies it told of, for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  struct Body {
    std::size_t index = 0;
    double size = 0.0;  // longest edge, 0: not known [m]
    DisplacementMeasure measure;
    bool was_told_large = false;
    bool was_told_soft = false;
  };
  void check_deformation(const SystemState& state, Body& body,
                         std::vector<std::string>& warnings) const;
  void check_speed(const SystemState& state, Body& body,
                   std::vector<std::string>& warnings) const;

  const SystemModel& model_;
  std::vector<Body> bodies_;
};

/// What is said of a body that turns too fast; nothing if it does not.
[[nodiscard]] std::optional<std::string> describe_softening(
    const BodyModel& body, const Vector3& w_WB_B);

}  // namespace limber::dynamics
