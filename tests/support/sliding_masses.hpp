// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dynamics/simulation.hpp"
#include "dynamics/system_builder.hpp"
#include "joints/joint_kind.hpp"

/// Rigid bodies on rails along x, for closed forms of one coordinate.
namespace limber::testing {

/// A body and the frame at its centre.
struct Mass {
  dynamics::BodyIndex body = 0;
  dynamics::AttachmentIndex frame = 0;
};

inline Mass add_mass(dynamics::SystemBuilder& builder, const std::string& name,
                     double mass) {
  Mass out;
  out.body = builder.add_rigid_body(name, {mass, Matrix3::Identity()});
  out.frame = builder.attach_frame(name, out.body, {});
  return out;
}

/// A rail along x, held stiffly, with elements along it.
inline dynamics::CouplerIndex add_rail(
    dynamics::SystemBuilder& builder, const Mass& mass, const std::string& name,
    std::vector<joints::JointElement> elements = {}) {
  return builder.add_coupler(
      name,
      joints::make_joint(
          joints::JointKind::prismatic, Vector3::UnitX(), Vector3::UnitY(),
          {.translational_stiffness = 1e7, .rotational_stiffness = 1e7},
          std::move(elements)),
      builder.attach_world("ground", {}), mass.frame);
}

/// A shaft along z, held stiffly, with elements about it.
inline dynamics::CouplerIndex add_shaft(
    dynamics::SystemBuilder& builder, const Mass& mass, const std::string& name,
    std::vector<joints::JointElement> elements = {}) {
  return builder.add_coupler(
      name,
      joints::make_joint(
          joints::JointKind::revolute, Vector3::UnitZ(), Vector3::UnitX(),
          {.translational_stiffness = 1e7, .rotational_stiffness = 1e7},
          std::move(elements)),
      builder.attach_world("ground", {}), mass.frame);
}

/// What a run leaves.
struct RunOutcome {
  dynamics::SystemState state;
  std::vector<dynamics::SystemState> states;
  std::vector<dynamics::EnergyBalance> energies;
  dynamics::SimulationStatistics statistics;
};

inline RunOutcome run_from(const dynamics::SystemModel& model,
                           const dynamics::SystemState& start,
                           const dynamics::SimulationSettings& settings) {
  RunOutcome out;
  out.state = start;
  out.statistics = simulate(
      model, out.state, settings,
      [&](const dynamics::SystemState& s, const dynamics::EnergyBalance& e) {
        out.states.push_back(s);
        out.energies.push_back(e);
      });
  return out;
}

}  // namespace limber::testing
