// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <optional>
#include <vector>

#include "limber/common/evaluation_time.hpp"
#include "limber/joints/coordinates/axis_coordinate.hpp"
#include "limber/joints/coordinates/discrete_gradient.hpp"
#include "limber/joints/coordinates/motion.hpp"
#include "limber/joints/coordinates/required_rotations.hpp"
#include "limber/joints/coordinates/switches.hpp"
#include "limber/joints/coupler_memory.hpp"
#include "limber/joints/scalar/scalar_law.hpp"
#include "limber/joints/scalar/scalar_law_kind.hpp"

/// Functions that a law between two frames provides. Those that do not apply to
/// a law it inherits from one of the bases below; a law that lacks a function
/// does not compile.
namespace limber::joints {

/// `evaluate_over_step` balances energies exactly (discrete_gradient.hpp).
template <typename Law>
concept ExertsForce = requires(const Law& law, const RelativeMotion& motion,
                               const CouplerMemory& memory,
                               const EvaluationTime& now,
                               const MotionStep& step, const StepTimes& times) {
  { law.evaluate(motion, memory, now) } -> std::same_as<CouplerResponse>;
  {
    law.evaluate_over_step(step, memory, times)
    } -> std::same_as<CouplerResponse>;
};

/// Rotations that the law needs from F and from M.
template <typename Law>
concept RequiresRotations = requires(const Law& law) {
  { law.find_required_rotations() } -> std::same_as<RequiredSides>;
};

/// Switches by index, at most kMaxSwitches; the event, if any, when one rises
/// or falls, given the memory before that; and the memory after one rose. A law
/// that stores past events has triggers; for all others the memory keeps the
/// switches' positions fixed through a step.
template <typename Law>
concept HasSwitches = requires(const Law& law, int index,
                               const RelativeMotion& motion,
                               const CouplerMemory& memory,
                               CouplerMemory& changed, double t, bool rises) {
  { law.switch_count() } -> std::same_as<int>;
  { law.find_switch(index, motion, memory, t) } -> std::same_as<SwitchValue>;
  {
    law.find_event(index, rises, memory)
    } -> std::same_as<std::optional<EventKind>>;
  { law.has_triggers() } -> std::same_as<bool>;
  law.update(index, motion, changed);
};
/// For laws whose switches the memory keeps fixed through a step, or that have
/// none.
struct WithoutTriggers {
  [[nodiscard]] static bool has_triggers() { return false; }
  static void update(int /*index*/, const RelativeMotion& /*motion*/,
                     CouplerMemory& /*memory*/) {}
};
struct WithoutSwitches : WithoutTriggers {
  [[nodiscard]] static int switch_count() { return 0; }
  [[nodiscard]] static SwitchValue find_switch(int /*index*/,
                                               const RelativeMotion& /*motion*/,
                                               const CouplerMemory& /*memory*/,
                                               double /*t*/) {
    return {};
  }
  [[nodiscard]] static std::optional<EventKind> find_event(
      int /*index*/, bool /*rises*/, const CouplerMemory& /*memory*/) {
    return std::nullopt;
  }
};

/// Coordinates, at most kMaxCoordinates, whose whole turns the memory counts,
/// and the scalar laws along them.
template <typename Law>
concept HasCoordinates = requires(const Law& law) {
  { law.coordinates() } -> std::same_as<const std::vector<AxisCoordinate>&>;
  { law.elements() } -> std::same_as<const std::vector<JointElement>&>;
};
struct WithoutCoordinates {
  [[nodiscard]] static const std::vector<AxisCoordinate>& coordinates();
  [[nodiscard]] static const std::vector<JointElement>& elements();
};

/// Commands: times at which one or its derivatives jump, increasing for each
/// [s]; the inputs that they follow; the velocity at which the law's dampers
/// exert no force, zero without a command [m/s, rad/s].
template <typename Law>
concept HasCommands = requires(const Law& law, const RelativeMotion& motion,
                               const CouplerMemory& memory,
                               const EvaluationTime& now) {
  { law.break_times() } -> std::same_as<std::vector<double>>;
  { law.find_inputs() } -> std::same_as<std::vector<int>>;
  { law.find_target_velocity(motion, memory, now) } -> std::same_as<Vector6>;
};
struct WithoutCommands {
  [[nodiscard]] static std::vector<double> break_times() { return {}; }
  [[nodiscard]] static std::vector<int> find_inputs() { return {}; }
  [[nodiscard]] static Vector6 find_target_velocity(
      const RelativeMotion& /*motion*/, const CouplerMemory& /*memory*/,
      const EvaluationTime& /*now*/) {
    return Vector6::Zero();
  }
};

/// Stiffness that replaces a constraint, and its deflection, which should stay
/// small; none for a law that is meant to deflect.
template <typename Law>
concept HasConstraint = requires(const Law& law,
                                 const ConstraintStiffness& stiffness,
                                 const RelativeMotion& motion) {
  {
    law.find_constraint_stiffness()
    } -> std::same_as<std::optional<ConstraintStiffness>>;
  {
    law.find_deflection(stiffness, motion)
    } -> std::same_as<ConstraintDeflection>;
};
struct WithoutConstraint {
  [[nodiscard]] static std::optional<ConstraintStiffness>
  find_constraint_stiffness() {
    return std::nullopt;
  }
  [[nodiscard]] static ConstraintDeflection find_deflection(
      const ConstraintStiffness& /*stiffness*/,
      const RelativeMotion& /*motion*/) {
    return {};
  }
};

/// Coordinates that a simulation can record, the law's own first, and the
/// forces along each.
template <typename Law>
concept HasReadings = requires(const Law& law, int coordinate,
                               const RelativeMotion& motion,
                               const CouplerMemory& memory,
                               const EvaluationTime& now) {
  { law.reading_kinds() } -> std::same_as<std::vector<AxisCoordinate::Kind>>;
  {
    law.read(coordinate, motion, memory, now)
    } -> std::same_as<CoordinateReading>;
};
struct WithoutReadings {
  [[nodiscard]] static std::vector<AxisCoordinate::Kind> reading_kinds() {
    return {};
  }
  /// @throws ContractError always: the law has no reading.
  [[nodiscard]] static CoordinateReading read(int coordinate,
                                              const RelativeMotion& motion,
                                              const CouplerMemory& memory,
                                              const EvaluationTime& now);
};

template <typename Law>
concept CouplerLawKind = ExertsForce<Law> && RequiresRotations<Law> &&
    HasSwitches<Law> && HasCoordinates<Law> && HasCommands<Law> &&
    HasConstraint<Law> && HasReadings<Law> && NamesItsFields<Law>;

}  // namespace limber::joints
