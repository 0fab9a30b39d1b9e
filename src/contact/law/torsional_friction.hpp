// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/fields.hpp"

namespace limber::contact {

/// Twist of a contact point's bristle about the normal: a plain value, part of
/// the state.
struct TwistMemory {
  double twist = 0.0;  ///< [rad]
};

constexpr auto fields_of(const TwistMemory*) {
  return list_fields("twist", "twist [rad]");
}

/// Rotation of the slave relative to the master about the normal, and the load.
struct TwistMotion {
  double increment = 0.0;       ///< since the memory was committed [rad]
  double velocity = 0.0;        ///< [rad/s]
  double normal_force = 0.0;    ///< f >= 0 [N]
  double contact_radius = 0.0;  ///< a >= 0, Hertz's at f [m]
};

/// Friction moment on the slave about the normal.
struct TwistResponse {
  double moment = 0.0;           ///< [N m]
  bool slips = false;            ///< the limit is reached
  double energy = 0.0;           ///< k_r twist^2 / 2 at the end [J]
  double slip_work = 0.0;        ///< lost to slip by the increment [J]
  double damper_power = 0.0;     ///< >= 0 [W]
  double by_increment = 0.0;     ///< d moment / d increment [N m/rad]
  double by_velocity = 0.0;      ///< d moment / d velocity [N m s/rad]
  double by_normal_force = 0.0;  ///< d moment / df, a with f^(1/3) [m]
  TwistMemory next = {};         ///< what to commit when the step is accepted
};

/// Friction against rotation about the normal on Hertz's area.
///
/// Equation   a bristle about the normal, as of BristleFriction, with the
///            limit 3 pi mu f a / 16: of full slip under Hertz's pressure
/// Source     [@johnson1985, ch. 7]
/// Limits     k_r holds for an area without slip, at a reference load; in
///            reality slip begins at the rim long before the limit. Sliding and
///            rotation do not weaken each other here.
class TorsionalFriction {
 public:
  struct Parameters {
    double friction = 0.0;   ///< mu >= 0 [-]
    double stiffness = 0.0;  ///< k_r > 0, see PairModuli [N m/rad]
    double damping = 0.0;    ///< >= 0 [N m s/rad]
  };

  /// @throws InputError for a value outside its range.
  explicit TorsionalFriction(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }

  /// Does not change the memory: memory = response.next commits.
  [[nodiscard]] TwistResponse evaluate(const TwistMemory& memory,
                                       const TwistMotion& motion) const;

 private:
  Parameters parameters_;
};

}  // namespace limber::contact
