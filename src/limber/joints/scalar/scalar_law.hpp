// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "limber/common/records/fields.hpp"
#include "limber/joints/scalar/drive.hpp"
#include "limber/joints/scalar/end_stop.hpp"
#include "limber/joints/scalar/friction.hpp"
#include "limber/joints/scalar/scalar_law_kind.hpp"
#include "limber/joints/scalar/scalar_spring.hpp"

/// Dispatch over all laws along a coordinate: other code calls these functions,
/// which call the law's own (scalar_law_kind.hpp).
namespace limber::joints {

/// Any law along one coordinate. A new law is added here, to
/// docs/reference/joints.md and to the contract tests of scalar laws.
using ScalarLaw = std::variant<ScalarSpring, Friction, EndStop, Drive>;

/// A scalar law along one of a coupler's coordinates.
struct JointElement {
  int coordinate = 0;  ///< its index
  ScalarLaw law;
};

constexpr auto fields_of(const JointElement*) {
  return list_fields("element", "coordinate", "law");
}

/// The law's response to a motion.
[[nodiscard]] ScalarResponse evaluate(const ScalarLaw& law,
                                      const ScalarMotion& motion,
                                      const EvaluationTime& now,
                                      const SwitchModes& modes = {});
/// Response over a step that balances energies exactly
/// (discrete_gradient.hpp).
[[nodiscard]] ScalarResponse evaluate_over_step(
    const ScalarLaw& law, const CoordinateStep& coordinate,
    const StepTimes& times, const SwitchModes& modes);

/// Number of switches of a law, and one of them by its index, from 0.
[[nodiscard]] int switch_count(const ScalarLaw& law);
[[nodiscard]] SwitchValue find_switch(const ScalarLaw& law, int index,
                                      const ScalarMotion& motion);
/// The event when a switch becomes positive (`rises`) or negative.
/// @throws ContractError for a law without switches.
[[nodiscard]] EventKind find_event(const ScalarLaw& law, bool rises);

/// Times at which a law's command or one of its derivatives jumps, increasing
/// [s].
[[nodiscard]] std::vector<double> break_times(const ScalarLaw& law);
/// Indices of the system's inputs that its command is made of.
[[nodiscard]] std::vector<int> find_inputs(const ScalarLaw& law);

/// Largest effort of the law; infinite without a limit [N or N m].
[[nodiscard]] double max_effort(const ScalarLaw& law);
/// Ratio of the commanded effort, before clipping, to the limit; 0 for a law
/// that is not commanded [-].
[[nodiscard]] double find_load(const ScalarLaw& law, const ScalarMotion& motion,
                               const EvaluationTime& now);

/// How a motor supplies power; nothing for a law without a command, or if the
/// path of its command is not known.
[[nodiscard]] std::optional<Supply> find_supply(const ScalarLaw& law,
                                                const ScalarMotion& motion,
                                                const EvaluationTime& now);

/// The bound that the coordinate exceeds, if any.
[[nodiscard]] std::optional<BeyondBound> find_beyond_bound(
    const ScalarLaw& law, const ScalarMotion& motion);

/// The rate at which the dampers of several laws along one coordinate exert no
/// force together.
class TargetRate {
 public:
  void add(const ScalarLaw& law, const ScalarMotion& motion,
           const EvaluationTime& now, const SwitchModes& modes);
  /// [m/s or rad/s]
  [[nodiscard]] double rate() const {
    return damping_ > 0.0 ? push_ / damping_ : 0.0;
  }

 private:
  double damping_ = 0.0;  // [N s/m or N m s/rad]
  double push_ = 0.0;     // sum of damping times rate [N or N m]
};

}  // namespace limber::joints
