// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/terms/energy_balance.hpp"
#include "metamorphic/random_draw.hpp"
#include "metamorphic/scene_plan.hpp"

namespace limber::metamorphic {

struct BodyMotion {
  Vector3 p_WB = Vector3::Zero();      ///< [m]
  Matrix3 R_WB = Matrix3::Identity();  ///< [-]
  Vector3 v_WB_W = Vector3::Zero();    ///< [m/s]
  Vector3 w_WB_B = Vector3::Zero();    ///< [rad/s]
  VectorX eta;                         ///< [kg^1/2 m]
  VectorX etadot;                      ///< [kg^1/2 m/s]
};

struct Output {
  double t = 0.0;                  ///< [s]
  std::vector<BodyMotion> bodies;  ///< in the order of the plan
  dynamics::EnergyBalance energy;
};

struct Motion {
  std::vector<std::string> names;  ///< of the bodies
  std::vector<Output> outputs;
  long steps = 0;  ///< count
  bool has_events = false;
  bool has_halved_steps = false;  ///< which Newton's method did not end
  bool has_jumps = false;         ///< of a load or command, within the run
  std::string refusal;            ///< the message, if the run did not finish
};

[[nodiscard]] Motion run(const ScenePlan& plan);

/// Largest differences at any output.
struct Difference {
  double position = 0.0;  ///< also of rotations and modes, as lengths [m]
  double velocity = 0.0;  ///< likewise [m/s]
  double energy = 0.0;    ///< of each kind of energy [J]
  double strain = 0.0;    ///< of elastic energy and couplers' alone [J]
  int compared = 0;       ///< count of bodies at outputs
};

/// Compares bodies of the same name at the outputs of `other`, which are among
/// those of `first`.
/// @param plan of `first`
[[nodiscard]] Difference compare(const ScenePlan& plan, const Motion& first,
                                 const Motion& other);

/// What makes a scene's numbers as large as they are.
struct Magnitude {
  double length = 0.0;  ///< farthest body, and its size [m]
  double speed = 0.0;   ///< [m/s]
  double energy = 0.0;  ///< [J]
  double force = 0.0;   ///< of all loads and weights [N]
};
[[nodiscard]] Magnitude measure(const ScenePlan& plan, const Motion& motion);

/// The plan with other starts: by eps times `place` and `speed`, as rounding
/// does, in positions, rotations, modes and their rates, and other places in
/// the world.
/// @param place [m], speed [m/s]
[[nodiscard]] ScenePlan disturb(ScenePlan plan, double place, double speed,
                                RandomDraw& draw);

}  // namespace limber::metamorphic
