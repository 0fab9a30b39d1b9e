// SPDX-License-Identifier: BSD-3-Clause
#include "support/sliding_masses.hpp"

#include <utility>

namespace limber::testing {
namespace {

dynamics::CouplerIndex join_to_ground(
    dynamics::SystemBuilder& builder, const Mass& mass, const std::string& name,
    joints::JointKind kind, const Vector3& axis, const Vector3& second,
    std::vector<joints::JointElement> elements) {
  return builder.add_coupler(name,
                             joints::make_joint(kind, axis, second,
                                                {.translational_stiffness = 1e7,
                                                 .rotational_stiffness = 1e7},
                                                std::move(elements)),
                             builder.attach_world("ground", {}), mass.frame);
}

}  // namespace

Mass add_mass(dynamics::SystemBuilder& builder, const std::string& name,
              double mass) {
  Mass out;
  out.body = builder.add_rigid_body(name, {mass, Matrix3::Identity()});
  out.frame = builder.attach_frame(name, out.body, {});
  return out;
}

dynamics::CouplerIndex add_rail(dynamics::SystemBuilder& builder,
                                const Mass& mass, const std::string& name,
                                std::vector<joints::JointElement> elements) {
  return join_to_ground(builder, mass, name, joints::JointKind::prismatic,
                        Vector3::UnitX(), Vector3::UnitY(),
                        std::move(elements));
}

dynamics::CouplerIndex add_shaft(dynamics::SystemBuilder& builder,
                                 const Mass& mass, const std::string& name,
                                 std::vector<joints::JointElement> elements) {
  return join_to_ground(builder, mass, name, joints::JointKind::revolute,
                        Vector3::UnitZ(), Vector3::UnitX(),
                        std::move(elements));
}

RunOutcome run_from(const dynamics::SystemModel& model,
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
