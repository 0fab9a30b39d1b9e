// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>

#include "limber/joints/bushing.hpp"
#include "limber/joints/coupler_law_kind.hpp"

namespace limber::joints {

/// A bushing that acts once two frames have come near each other, is relaxed in
/// their relative pose at that time, and acts until it is released for good.
///
/// Equation   closes when |p_FM| falls to `reach`; then the bushing's, with
///            p_FM - p_0 and R_FM R_0^T. Opens at `release_time` or when its
///            spring force exceeds `release_force`; the energy stored at that
///            time is lost. A latch released before it closes never closes.
class Latch : public WithoutCoordinates,
              public WithoutCommands,
              public WithoutConstraint,
              public WithoutReadings {
 public:
  /// No release by force or at a time [N or s].
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  struct Parameters {
    double reach = 0.0;  ///< > 0 [m]
    Bushing::Parameters bushing = {};
    double release_force = kNever;  ///< > 0 [N]
    double release_time = kNever;   ///< > -infinity [s]
  };

  /// @throws InputError for a value outside its range.
  explicit Latch(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion,
                                         const CouplerMemory& memory) const;
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion,
                                         const CouplerMemory& memory,
                                         const EvaluationTime& /*now*/) const {
    return evaluate(motion, memory);
  }
  /// The response at the mean, as that of its bushing.
  [[nodiscard]] CouplerResponse evaluate_over_step(
      const MotionStep& motion, const CouplerMemory& memory,
      const StepTimes& /*times*/) const {
    return evaluate(motion.mean, memory);
  }

  /// Those of its bushing in any relative orientation, since it may close in
  /// any.
  [[nodiscard]] RequiredSides find_required_rotations() const;

  /// Switch 0 rises through zero when an open latch closes, (reach^2 - p^2) /
  /// (2 reach) [m], or a closed one is released by its force f, (f^2 - F^2) /
  /// (2 F) [N]; switch 1 at the release time [s].
  [[nodiscard]] static int switch_count() { return 2; }
  [[nodiscard]] SwitchValue find_switch(int index, const RelativeMotion& motion,
                                        const CouplerMemory& memory,
                                        double t) const;
  [[nodiscard]] static std::optional<EventKind> find_event(
      int index, bool rises, const CouplerMemory& memory);
  /// The memory's latch status stores past events.
  [[nodiscard]] static bool has_triggers() { return true; }
  /// Updates the memory after switch `index` became positive.
  void update(int index, const RelativeMotion& motion,
              CouplerMemory& memory) const;

 private:
  Parameters parameters_;
  Bushing bushing_;
};

constexpr auto fields_of(const Latch::Parameters*) {
  return list_fields("latch", "reach [m]", "bushing", "release force [N]",
                     "release time [s]");
}

}  // namespace limber::joints
