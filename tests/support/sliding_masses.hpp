// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"

/// Rigid bodies on rails along x, for closed forms of one coordinate.
namespace limber::testing {

/// A body and the frame at its centre.
struct Mass {
  dynamics::BodyIndex body;
  dynamics::AttachmentIndex frame;
};

Mass add_mass(dynamics::SystemBuilder& builder, const std::string& name,
              double mass);

/// A rail along x, held stiffly, with elements along it.
dynamics::CouplerIndex add_rail(
    dynamics::SystemBuilder& builder, const Mass& mass, const std::string& name,
    std::vector<joints::JointElement> elements = {});

/// A shaft along z, held stiffly, with elements about it.
dynamics::CouplerIndex add_shaft(
    dynamics::SystemBuilder& builder, const Mass& mass, const std::string& name,
    std::vector<joints::JointElement> elements = {});

/// What a run leaves.
struct RunOutcome {
  dynamics::SystemState state;
  std::vector<dynamics::SystemState> states;
  std::vector<dynamics::EnergyBalance> energies;
  dynamics::SimulationStatistics statistics;
};

RunOutcome run_from(const dynamics::SystemModel& model,
                    const dynamics::SystemState& start,
                    const dynamics::SimulationSettings& settings);

}  // namespace limber::testing
