// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "limber/common/evaluation_time.hpp"
#include "limber/common/records/fields.hpp"
#include "limber/joints/coordinates/discrete_gradient.hpp"
#include "limber/joints/coordinates/scalar_motion.hpp"
#include "limber/joints/coordinates/switches.hpp"

/// Functions that a law along one coordinate provides. Those that do not apply
/// to a law it inherits from one of the bases below; a law that lacks a
/// function does not compile.
namespace limber::joints {

/// Excess of a coordinate over one of a law's bounds.
struct BeyondBound {
  double bound = 0.0;   ///< [m or rad]
  double by = 0.0;      ///< excess > 0 [m or rad]
  double energy = 0.0;  ///< stored by the excess [J]
};

/// How a motor supplies power, as a force along a path: the work over a time is
/// the integral of the force over the place.
struct Supply {
  double force = 0.0;  ///< [N or N m]
  double place = 0.0;  ///< [m or rad]
  double rate = 0.0;   ///< of the place [m/s or rad/s]
};

/// `evaluate_over_step` balances energies exactly (discrete_gradient.hpp).
template <typename Law>
concept ExertsScalarForce = requires(const Law& law, const ScalarMotion& motion,
                                     const EvaluationTime& now,
                                     const SwitchModes& modes,
                                     const CoordinateStep& coordinate,
                                     const StepTimes& times) {
  { law.evaluate(motion, now, modes) } -> std::same_as<ScalarResponse>;
  {
    law.evaluate_over_step(coordinate, times, modes)
    } -> std::same_as<ScalarResponse>;
};

/// Switches by index, at most kMaxScalarSwitches; the event when one rises or
/// falls.
template <typename Law>
concept HasScalarSwitches = requires(const Law& law, int index,
                                     const ScalarMotion& motion, bool rises) {
  { law.switch_count() } -> std::same_as<int>;
  { law.find_switch(index, motion) } -> std::same_as<SwitchValue>;
  { law.find_event(rises) } -> std::same_as<EventKind>;
};
struct WithoutScalarSwitches {
  [[nodiscard]] static int switch_count() { return 0; }
  [[nodiscard]] static SwitchValue find_switch(int /*index*/,
                                               const ScalarMotion& /*motion*/) {
    return {};
  }
  /// @throws ContractError always: the law has no switch.
  [[nodiscard]] static EventKind find_event(bool rises);
};

/// A command: times at which it or one of its derivatives jumps, increasing
/// [s]; the inputs that it follows; the rate at which the law's damper exerts
/// no force [m/s or rad/s]; the largest effort [N or N m], and the ratio of the
/// effort before clipping to it [-]; the supply, whose force times rate is
/// ScalarResponse::supplied, if its place is known.
template <typename Law>
concept HasCommand = requires(const Law& law, const EvaluationTime& now,
                              const ScalarMotion& motion) {
  { law.break_times() } -> std::same_as<std::vector<double>>;
  { law.find_inputs() } -> std::same_as<std::vector<int>>;
  { law.find_target_rate(now) } -> std::same_as<double>;
  { law.max_effort() } -> std::same_as<double>;
  { law.find_load(motion, now) } -> std::same_as<double>;
  { law.find_supply(motion, now) } -> std::same_as<std::optional<Supply>>;
};
struct WithoutCommand {
  [[nodiscard]] static std::vector<double> break_times() { return {}; }
  [[nodiscard]] static std::vector<int> find_inputs() { return {}; }
  [[nodiscard]] static double find_target_rate(const EvaluationTime& /*now*/) {
    return 0.0;
  }
  [[nodiscard]] static double max_effort() {
    return std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] static double find_load(const ScalarMotion& /*motion*/,
                                        const EvaluationTime& /*now*/) {
    return 0.0;
  }
  [[nodiscard]] static std::optional<Supply> find_supply(
      const ScalarMotion& /*motion*/, const EvaluationTime& /*now*/) {
    return {};
  }
};

/// Bounds within which a simulation should start.
template <typename Law>
concept HasBounds = requires(const Law& law, const ScalarMotion& motion) {
  { law.find_beyond_bound(motion) } -> std::same_as<std::optional<BeyondBound>>;
};
struct WithoutBounds {
  [[nodiscard]] static std::optional<BeyondBound> find_beyond_bound(
      const ScalarMotion& /*motion*/) {
    return std::nullopt;
  }
};

/// `fields_of(const Law::Parameters*)` exists: names of the parameters, which
/// manifests and checkpoints compare (common/records/fields.hpp).
template <typename Law>
concept NamesItsFields = requires(const Law& law) {
  requires HasFields<std::remove_cvref_t<decltype(law.parameters())>>;
};

template <typename Law>
concept ScalarLawKind = ExertsScalarForce<Law> && HasScalarSwitches<Law> &&
    HasCommand<Law> && HasBounds<Law> && NamesItsFields<Law>;

}  // namespace limber::joints
