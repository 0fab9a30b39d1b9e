// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/types.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// Axial load and strain of a body at one time.
struct AxialState {
  double fraction = 0.0;  ///< of what makes it buckle, > 0 under tension [-]
  double strain = 0.0;    ///< mean, > 0 under tension [-]
};

/// Axial load of a body, compared with its buckling load and its axial
/// stiffness: estimates of the geometric stiffness that levels up to `coupled`
/// lack, and of the nonlinearity of axial strain that `nonlinear` lacks,
/// without tables of second order.
///
/// Equation   N_a / P_a = a' T a / (c lambda S_a) for each long axis a, with
///            the integral of the stress T = sym(sum r f' - S0 [w]^2), r and f
///            of the forces on the body, S0 = int x x' dm, S_a = a' S0 a, and
///            lambda the lowest eigenvalue of the body, held at a joint if it
///            has one. Mean strain e_a = a' T a C_a / (1.2 S_a^2), C_a = sum
///            s_k^2 / lambda_k, s_k = a' int x phi_k' dm a
/// Source     T: virial theorem; c: ratio of the first eigenvalue to Euler's
///            load P L^2 / (E I) of a uniform beam: 2.467 * 12 / 12.36 = 2.4
///            (clamped, free), and of a free one that to the slope of its mode,
///            12 / 49.48 = 0.243 [@blevins1979]; 1.2: E V C_a / S_a^2 of a
///            uniform bar that spins, int N^2 / (E A) dx = (rho A)^2 L^5 / (120
///            E A)
/// Limits     long axes: S_a at least a tenth of the largest. Neglects
///            contacts, files of nodal forces and moments; none for a clamped
///            body. A basis without axial modes shows no strain.
class AxialLoad {
 public:
  AxialLoad(const SystemModel& model, BodyIndex body);

  /// @param terms at the state, with the forces of couplers
  /// @returns the values of the axis with the largest magnitude, for each
  [[nodiscard]] AxialState calc_state(const SystemState& state, Side side,
                                      const SystemTerms& terms) const;
  /// Axial part of each mode, along any long axis: the largest |s_k| /
  /// sqrt(S_a), from 0 to 1 [-].
  [[nodiscard]] const VectorX& stretch() const { return stretch_; }
  /// Lowest frequency of the body alone, held at a joint if it has one [rad/s].
  [[nodiscard]] double frequency() const { return frequency_; }
  [[nodiscard]] bool is_held() const { return is_held_; }

 private:
  [[nodiscard]] bool is_on_body(AttachmentIndex frame) const;
  [[nodiscard]] Matrix3 calc_stress(const SystemState& state, Side side,
                                    const SystemTerms& terms) const;

  const SystemModel* model_;
  BodyIndex body_;
  std::vector<std::size_t> couplers_;  // that end on it
  bool is_held_ = false;
  double frequency_ = 0.0;
  Matrix3 axes_ = Matrix3::Identity();  // columns, principal axes of S0
  Vector3 loads_ = Vector3::Zero();     // c lambda S_a, 0: not long [J]
  Vector3 softness_ = Vector3::Zero();  // C_a / (1.2 S_a^2) [1/J]
  VectorX stretch_;
  Matrix3 S0_ = Matrix3::Zero();  // [kg m^2]
};

/// Largest rotation of the body's interfaces relative to its mean axes, and to
/// one another [rad].
struct InterfaceRotation {
  double own = 0.0;
  double relative = 0.0;
};
/// To first order in eta. @param eta m, the body's modal coordinates [kg^1/2 m]
[[nodiscard]] InterfaceRotation find_rotation(
    const std::vector<const Attachment*>& interfaces, const VectorX& eta);
/// Attachments on a body, valid as long as the model.
[[nodiscard]] std::vector<const Attachment*> find_interfaces(
    const SystemModel& model, BodyIndex body);

}  // namespace limber::dynamics
