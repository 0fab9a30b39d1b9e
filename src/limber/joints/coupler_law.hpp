// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "limber/joints/bushing.hpp"
#include "limber/joints/coupler_law_kind.hpp"
#include "limber/joints/joint.hpp"
#include "limber/joints/latch.hpp"
#include "limber/joints/point_spring.hpp"

/// Dispatch over all laws between two frames: other code calls these functions,
/// which call the law's own (coupler_law_kind.hpp).
namespace limber::joints {

/// Any law between two frames. A new law is added here, to
/// docs/reference/joints.md and to the contract tests of coupler laws.
using CouplerLaw = std::variant<Bushing, PointSpring, Joint, Latch>;

/// @throws NumericalError as the law does.
[[nodiscard]] CouplerResponse evaluate(const CouplerLaw& law,
                                       const RelativeMotion& motion,
                                       const CouplerMemory& memory,
                                       const EvaluationTime& now);
/// Response over a step that balances energies exactly
/// (discrete_gradient.hpp).
/// @throws NumericalError as the law does.
[[nodiscard]] CouplerResponse evaluate_over_step(const CouplerLaw& law,
                                                 const MotionStep& motion,
                                                 const CouplerMemory& memory,
                                                 const StepTimes& times);

/// Rotations that the law needs from the frames that it joins.
[[nodiscard]] RequiredSides find_required_rotations(const CouplerLaw& law);

/// Number of switches of a law; they are indexed from 0.
[[nodiscard]] int switch_count(const CouplerLaw& law);
/// @param t time [s]
/// @throws ContractError for an index that is not below the count.
/// @throws NumericalError as AxisCoordinate does.
[[nodiscard]] SwitchValue find_switch(const CouplerLaw& law, int index,
                                      const RelativeMotion& motion,
                                      const CouplerMemory& memory, double t);
/// The event at a sign change of a switch, if any.
/// @param rises whether the value becomes positive
/// @param memory before the change
/// @throws ContractError for an index that is not below the count.
[[nodiscard]] std::optional<EventKind> find_event(const CouplerLaw& law,
                                                  int index, bool rises,
                                                  const CouplerMemory& memory);
/// Whether the law stores the effects of its switches, such as a latch's
/// status, rather than their positions.
[[nodiscard]] bool has_triggers(const CouplerLaw& law);
/// Updates the coupler's memory after switch `index` became positive.
void update_memory(const CouplerLaw& law, int index,
                   const RelativeMotion& motion, CouplerMemory& memory);

/// The law's coordinates, and the scalar laws along them; empty unless it is a
/// joint.
[[nodiscard]] const std::vector<AxisCoordinate>& coordinates_of(
    const CouplerLaw& law);
[[nodiscard]] const std::vector<JointElement>& elements_of(
    const CouplerLaw& law);

/// Times at which a drive's command or one of its derivatives jumps, increasing
/// for each drive [s].
[[nodiscard]] std::vector<double> break_times(const CouplerLaw& law);
/// Indices of the system's inputs that its drives follow.
[[nodiscard]] std::vector<int> find_inputs(const CouplerLaw& law);
/// The velocity (v_FM_F, w_FM_F) at which the law's dampers exert no force:
/// that commanded by its drives, else zero [m/s, rad/s].
[[nodiscard]] Vector6 find_target_velocity(const CouplerLaw& law,
                                           const RelativeMotion& motion,
                                           const CouplerMemory& memory,
                                           const EvaluationTime& now);

/// Stiffness of the directions that the law should constrain, none for a law
/// that is meant to deflect; and its deflection in those directions.
[[nodiscard]] std::optional<ConstraintStiffness> find_constraint_stiffness(
    const CouplerLaw& law);
[[nodiscard]] ConstraintDeflection find_deflection(
    const CouplerLaw& law, const ConstraintStiffness& stiffness,
    const RelativeMotion& motion);

/// Whether the law is a joint without deflection, which CouplerMemory's
/// constraint wrench holds.
[[nodiscard]] bool is_ideal(const CouplerLaw& law);
/// @throws ContractError unless the law is a joint.
[[nodiscard]] ConstraintGap find_constraint_gap(const CouplerLaw& law,
                                                const RelativeMotion& motion);

/// Coordinates that a simulation can record, and one of them: those of a joint,
/// the length of a spring.
[[nodiscard]] std::vector<AxisCoordinate::Kind> reading_kinds(
    const CouplerLaw& law);
/// @throws ContractError for a coordinate that does not exist.
/// @throws NumericalError where it is undefined.
[[nodiscard]] CoordinateReading read(const CouplerLaw& law, int coordinate,
                                     const RelativeMotion& motion,
                                     const CouplerMemory& memory,
                                     const EvaluationTime& now);

}  // namespace limber::joints
