// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/system/default_stiffness.hpp"
#include "limber/joints/coupler_law.hpp"
#include "limber/joints/joint_kind.hpp"
#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"

/// Laws of couplers from the specifications in robot and scenario files. All
/// throw InputError for values outside their range.
namespace limber::scene {

using dynamics::StopStiffness;

/// Elements along the coordinates of a joint.
/// @param stiffness default of stops
[[nodiscard]] std::vector<joints::JointElement> make_elements(
    const std::vector<JointAction>& actions,
    const std::vector<joints::AxisCoordinate>& coordinates,
    const StopStiffness& stiffness);

/// A drive; its limits are the scenario's, else these.
/// @param max_effort [N or N m] @param max_speed [m/s or rad/s]
[[nodiscard]] joints::Drive make_drive(const DriveSpec& spec, double max_effort,
                                       double max_speed);

/// @param length of the spring at the start [m]
[[nodiscard]] joints::PointSpring make_spring(const SpringOptions& options,
                                              double length);

/// @param held stiffness and damping of the closed latch
[[nodiscard]] joints::Latch make_latch(const Latch& latch,
                                       const joints::JointParameters& held);

/// @param length of the tendon at the start [m]
[[nodiscard]] std::vector<joints::ScalarLaw> make_tendon_laws(
    const Tendon& tendon, double length);

/// Stiffness and damping along a coordinate.
struct Constraint {
  double stiffness = 0.0;  ///< [N m/rad or N/m]
  double damping = 0.0;    ///< [N m s/rad or N s/m]
};

/// A joint's stiffness and damping of constrained rotations for an angle, of
/// translations for a distance.
[[nodiscard]] Constraint find_constraint(
    const joints::AxisCoordinate& coordinate,
    const joints::JointParameters& held);

/// Spring and damper of q - ratio q_with - offset. Default values are those of
/// the softer joint, for q_with referred to q: / ratio^2.
[[nodiscard]] joints::ScalarSpring make_gear_spring(const Gear& gear,
                                                    const Constraint& joint,
                                                    const Constraint& with);

}  // namespace limber::scene
