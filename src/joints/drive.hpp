// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "joints/scalar_motion.hpp"
#include "joints/signal.hpp"

namespace limber::joints {

/// What a drive's signal commands.
enum class DriveMode {
  position,  ///< z, by a spring and a damper to where it should be
  velocity,  ///< the rate, by a damper
  effort,    ///< the force or moment
};

/// A motor along a coordinate that follows a signal s(t), within limits.
///
/// Equation   position: force = -clip(k (z - s) + c (z' - s')),
///            velocity: force = -clip(c (z' - s)),
///            effort:   force = clip(s), clip to +-max_effort.
///            The energy is that of the clipped spring, the integral of
///            clip(k e) by e = z - s; the dissipation that of the damper, >= 0
///            also where the limit acts. An effort that goes with the motion
///            falls to zero between max_speed and kOverspeed times it. A drive
///            that only pulls clips to 0 ... max_effort instead, and its effort
///            pulls: force = -clip(s).
/// Limits     max_speed bounds what position and velocity drives are asked for,
///            not what loads make of it. The motor's own dynamics and the heat
///            in it are left out.
class Drive {
 public:
  static constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  struct Parameters {
    DriveMode mode = DriveMode::position;
    Signal signal = {};
    double stiffness = 0.0;          ///< k > 0 if position [N/m, N m/rad]
    double damping = 0.0;            ///< c >= 0 [N s/m, N m s/rad]
    double max_effort = kUnlimited;  ///< > 0 [N, N m]
    double max_speed = kUnlimited;   ///< > 0 [m/s, rad/s]
    bool pulls_only = false;         ///< of a tendon
  };
  static constexpr double kOverspeed = 1.1;

  /// @throws InputError for a value outside its range, or a signal that asks
  /// for more speed or effort than the limits.
  explicit Drive(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] ScalarResponse evaluate(const ScalarMotion& motion,
                                        const Instant& now) const;

 private:
  // A value within the limits, and whether the limits left it alone.
  struct Clipped {
    double value = 0.0;
    bool is_free = true;
  };
  [[nodiscard]] Clipped clip(double pull) const;
  [[nodiscard]] ScalarResponse push(const ScalarMotion& motion,
                                    double effort) const;
  [[nodiscard]] double clipped_energy(double error) const;

  Parameters parameters_;
};

}  // namespace limber::joints
