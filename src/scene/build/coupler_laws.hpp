// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "joints/coupler_law.hpp"
#include "joints/joint_kind.hpp"
#include "scene/default_stiffness.hpp"
#include "scene/robot.hpp"
#include "scene/scenario.hpp"

/// Laws of couplers from what a robot's and a scenario's files say of them.
/// All throw InputError for values outside their range.
namespace limber::scene {

/// What acts along the coordinates of a joint.
/// @param stiffness of a stop that gives none
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

/// How stiffly something holds along a coordinate.
struct Hold {
  double stiffness = 0.0;  ///< [N m/rad or N/m]
  double damping = 0.0;    ///< [N m s/rad or N s/m]
};

/// What a joint holds its rotations with for an angle, its translations for a
/// distance.
[[nodiscard]] Hold find_hold(const joints::AxisCoordinate& coordinate,
                             const joints::JointParameters& held);

/// Spring and damper of q - ratio q_with - offset. What the gear does not give
/// is that of the softer joint's hold, of q_with as q feels it: / ratio^2.
[[nodiscard]] joints::ScalarSpring make_gear_spring(const Gear& gear,
                                                    const Hold& joint,
                                                    const Hold& with);

}  // namespace limber::scene
