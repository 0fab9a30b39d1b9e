// SPDX-License-Identifier: BSD-3-Clause
#include "support/chain.hpp"

#include <cstddef>
#include <string>

#include "support/point_mass_body.hpp"

namespace limber::testing {

Chain make_chain(const ChainOptions& options) {
  const PointMassBody body =
      make_point_mass_body(24, options.modes, 4.0, 1.0, options.lowest, 42);
  const auto reduced = share(body);
  const auto near = make_interface(body, 0, 6);
  const auto far = make_interface(body, 6, 12);
  const joints::Bushing bushing =
      joints::make_joint_bushing(options.joint, Vector3::UnitX(),
                                 {.translational_stiffness = options.stiffness,
                                  .rotational_stiffness = options.stiffness,
                                  .translational_damping = options.damping,
                                  .rotational_damping = options.damping});
  Chain chain;
  for (int i = 0; i < options.bodies; ++i) {
    const auto b =
        chain.builder.add_flexible_body("link" + std::to_string(i), reduced,
                                        options.fidelity, options.body_damping);
    const auto root = chain.builder.attach_interface(
        "root", b, near, {Matrix3::Identity(), near.p_B});
    if (i > 0) {
      chain.builder.add_coupler("joint" + std::to_string(i), bushing,
                                chain.last_interfaces.back(), root);
    }
    chain.last_interfaces.push_back(chain.builder.attach_interface(
        "tip", b, far, {Matrix3::Identity(), far.p_B}));
  }
  chain.state = dynamics::make_state(chain.builder.build());
  for (int i = 0; i < options.bodies; ++i) {
    chain.state.bodies[static_cast<std::size_t>(i)].p_WB =
        i * (far.p_B - near.p_B);
  }
  return chain;
}

dynamics::SystemModel make_uncoupled_chain(int bodies) {
  return make_chain(
             {.bodies = bodies, .fidelity = dynamics::Fidelity::uncoupled})
      .builder.build();
}

Chain make_loaded_chain(double stiffness, double damping,
                        const dynamics::TimeFunction& load) {
  Chain chain = make_chain({.bodies = 3,
                            .modes = 4,
                            .stiffness = stiffness,
                            .damping = damping,
                            .joint = joints::JointKind::revolute,
                            .lowest = 20.0});
  chain.builder.set_gravity({0, 0, -2});
  chain.builder.add_load("push", chain.last_interfaces.back(), {0, 8, 1},
                         {0.5, 0, 0.2}, dynamics::LoadFrame::body, load);
  return chain;
}

}  // namespace limber::testing
