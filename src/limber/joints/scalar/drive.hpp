// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "limber/joints/scalar/scalar_law_kind.hpp"
#include "limber/joints/scalar/signal.hpp"

namespace limber::joints {

/// The quantity that a drive's signal commands.
enum class DriveMode {
  position,  ///< z, by a spring and a damper to the commanded value
  velocity,  ///< the rate, by a damper
  effort,    ///< the force or moment
};

/// A motor along a coordinate that follows a signal s(t), within limits.
///
/// Equation   position: force = -clip(k (z - s) + c (z' - s')),
///            velocity: force = -clip(c (z' - s)),
///            effort:   force = clip(s), clip to +-max_effort.
///            The energy is that of the clipped spring, the integral of
///            clip(k e) over e = z - s; the dissipation is that of the damper,
///            >= 0 also at the limit. The effort of an effort drive in the
///            direction of motion falls to zero between max_speed and
///            kOverspeed max_speed. A drive that only pulls clips to
///            [0, max_effort], and a positive effort pulls: force = -clip(s).
/// Limits     max_speed bounds the commands of position and velocity drives,
///            not the speed that loads cause. The motor's own dynamics and heat
///            are neglected.
class Drive : public WithoutScalarSwitches, public WithoutBounds {
 public:
  /// No limit [unit of the limited quantity].
  static constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  struct Parameters {
    DriveMode mode = DriveMode::position;
    Signal signal = {};
    double stiffness = 0.0;          ///< k > 0 if position [N/m, N m/rad]
    double damping = 0.0;            ///< c >= 0 [N s/m, N m s/rad]
    double max_effort = kUnlimited;  ///< > 0 [N, N m]
    double max_speed = kUnlimited;   ///< > 0 [m/s, rad/s]
    bool pulls_only = false;         ///< a tendon
  };
  static constexpr double kOverspeed = 1.1;  ///< of max_speed [-]

  /// @throws InputError for a value outside its range, or a signal that
  /// commands a speed or effort above the limits. An input is not known in
  /// advance: it is clipped to the limits, and a position drive that follows
  /// one cannot limit its speed.
  explicit Drive(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] ScalarResponse evaluate(const ScalarMotion& motion,
                                        const EvaluationTime& now,
                                        const SwitchModes& modes = {}) const;
  /// The response at the mean; the remainder of the energy balance counts as
  /// supplied.
  [[nodiscard]] ScalarResponse evaluate_over_step(
      const CoordinateStep& coordinate, const StepTimes& times,
      const SwitchModes& modes) const;

  [[nodiscard]] std::vector<double> break_times() const;
  [[nodiscard]] std::vector<int> find_inputs() const;
  [[nodiscard]] double find_target_rate(const EvaluationTime& now) const;
  [[nodiscard]] double max_effort() const { return parameters_.max_effort; }
  /// 0 for an effort drive, whose command respects the limit.
  [[nodiscard]] double find_load(const ScalarMotion& motion,
                                 const EvaluationTime& now) const;
  /// Along the command: of a position drive its value, of a velocity drive its
  /// integral; of an effort drive along the coordinate.
  [[nodiscard]] std::optional<Supply> find_supply(
      const ScalarMotion& motion, const EvaluationTime& now) const;

 private:
  // A value within the limits, and whether it was so before clipping.
  struct Clipped {
    double value = 0.0;
    bool is_free = true;
  };
  [[nodiscard]] SignalValue find_command(const EvaluationTime& now) const;
  [[nodiscard]] Clipped clip(double pull) const;
  [[nodiscard]] ScalarResponse push(const ScalarMotion& motion,
                                    double effort) const;
  [[nodiscard]] double clipped_energy(double error) const;

  Parameters parameters_;
};

constexpr auto fields_of(const Drive::Parameters*) {
  return list_fields("drive", "mode", "signal", "stiffness [N/m, N m/rad]",
                     "damping [N s/m, N m s/rad]", "max effort [N, N m]",
                     "max speed [m/s, rad/s]", "pulls only");
}

}  // namespace limber::joints
