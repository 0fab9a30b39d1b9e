// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/fields.hpp"
#include "limber/common/types.hpp"
#include "limber/contact/law/friction_limit.hpp"

namespace limber::contact {

/// Friction history of a contact point between steps: a plain value, part of
/// the state. Expressed in frame S of the slave side, with which it therefore
/// rotates.
struct BristleMemory {
  Vector3 s_S = Vector3::Zero();  ///< deflection of the bristle [m]
  Vector3 normal_S =
      Vector3::Zero();  ///< to which it is tangent; 0 of a new one
};

constexpr auto fields_of(const BristleMemory*) {
  return list_fields("bristle", "s_S [m]", "normal_S");
}

/// Motion of the slave's point relative to the master's that it touches; its
/// normal part is ignored.
struct BristleMotion {
  Vector3 normal_S = Vector3::Zero();  ///< unit vector [-]
  /// Since the last commit, from positions, because a rate times the step
  /// drifts [m].
  Vector3 increment_S = Vector3::Zero();
  Vector3 velocity_S = Vector3::Zero();  ///< [m/s]
  double normal_force = 0.0;             ///< f >= 0, damping included [N]
};

/// Friction on the slave's point, expressed in S.
struct BristleResponse {
  Vector3 force_S = Vector3::Zero();  ///< t [N]
  bool slips = false;                 ///< the cone limits it
  double energy = 0.0;                ///< k_t s^2 / 2 at the end [J]
  double slip_work = 0.0;             ///< lost to slip by the increment [J]
  double damper_power = 0.0;          ///< >= 0 [W]
  Matrix3 by_increment = Matrix3::Zero();     ///< dt/d increment [N/m]
  Matrix3 by_velocity = Matrix3::Zero();      ///< dt/d velocity [N s/m]
  Vector3 by_normal_force = Vector3::Zero();  ///< dt/df [-]
  BristleMemory next = {};  ///< what to commit when the step is accepted
};

/// Coulomb friction with sticking at one contact point: a bristle with return
/// mapping.
///
/// Equation   t = -k_t s - c_t v within the cone |t| <= mu f; beyond it both
///            the bristle and t come back to the cone (cone_return.hpp), with
///            s* = Q s_0 + P increment, P = 1 - n n^T and Q the least rotation
///            from the last normal to n. Energy k_t s^2 / 2; over an increment
///            -t . increment = d energy + slip work + damper power h, but for
///            k_t |s - Q s_0|^2 / 2 where t is taken at the increment's end
/// Source     [@wriggers2006, ch. 5]; k_t of [@mindlin1949]
/// Limits     k_t is constant: that at a reference load; mu is that of the
///            velocity at the end. A turn of the normal by pi, as over an
///            edge, forgets the bristle. Derivatives with respect to n are
///            not given.
class BristleFriction {
 public:
  struct Parameters {
    FrictionLimit limit = {};  ///< mu
    double stiffness = 0.0;    ///< k_t > 0 [N/m]
    double damping = 0.0;      ///< c_t >= 0 [N s/m]
  };

  /// @throws InputError for a value outside its range.
  explicit BristleFriction(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }

  /// Does not change the memory: memory = response.next commits. At f = 0 the
  /// next memory is undeflected. NaN propagates.
  [[nodiscard]] BristleResponse evaluate(const BristleMemory& memory,
                                         const BristleMotion& motion) const;

 private:
  Parameters parameters_;
};

/// c_t as a share [-] of the critical damping of `mass` on k_t [N s/m].
/// @throws ContractError for a value < 0 or NaN.
[[nodiscard]] double find_bristle_damping(double stiffness, double mass,
                                          double share = 0.1);

}  // namespace limber::contact
