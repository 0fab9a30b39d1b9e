// SPDX-License-Identifier: BSD-3-Clause
#include "beam_chain.hpp"

#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"
#include "limber/reduction/reduce.hpp"

namespace limber::bench {

flexbody::ReducedBody reduce_beam(const std::string& mesh) {
  flexbody::Recipe recipe;
  recipe.name = "beam";
  recipe.mesh.file =
      std::string(LIMBER_SOURCE_DIR) + "/tests/data/beam/" + mesh;
  recipe.materials = {{"", {200e9, 0.0, 8000.0}}};
  recipe.interfaces = {{"root", flexbody::GroupNodes{"root"},
                        flexbody::Weighting::uniform, true},
                       {"tip", flexbody::GroupNodes{"tip"},
                        flexbody::Weighting::uniform, false}};
  recipe.basis.eigenmodes = 4;
  return reduce(recipe);
}

BeamChain make_beam_chain(
    const std::shared_ptr<const flexbody::ReducedBody>& body, int count,
    double swing) {
  constexpr double kStiffness = 1e12;  // [N/m], [N m/rad]
  const flexbody::InterfaceTable& root = body->interfaces[0];
  const flexbody::InterfaceTable& tip = body->interfaces[1];
  const joints::Bushing hinge =
      joints::make_joint_bushing(joints::JointKind::revolute, Vector3::UnitX(),
                                 {.translational_stiffness = kStiffness,
                                  .rotational_stiffness = kStiffness,
                                  .translational_damping = 1e-5 * kStiffness,
                                  .rotational_damping = 1e-5 * kStiffness});
  dynamics::SystemBuilder builder;
  dynamics::AttachmentIndex last_tip;
  for (int i = 0; i < count; ++i) {
    const auto b = builder.add_flexible_body(
        "beam" + std::to_string(i), body, dynamics::Fidelity::coupled,
        {.rayleigh_stiffness = 1e-6, .ratios = {}});
    const auto at_root = builder.attach_interface(
        "root" + std::to_string(i), b, root, {Matrix3::Identity(), root.p_B});
    if (i > 0) {
      builder.add_coupler("hinge" + std::to_string(i), hinge, last_tip,
                          at_root);
    } else if (swing != 0.0) {
      builder.add_load("swing", at_root, swing * Vector3::UnitY(),
                       Vector3::Zero(), dynamics::LoadFrame::world,
                       dynamics::Sinusoid{20.0});
    }
    last_tip = builder.attach_interface("tip" + std::to_string(i), b, tip,
                                        {Matrix3::Identity(), tip.p_B});
  }
  BeamChain chain{builder.build(), {}};
  chain.state = make_state(chain.model);
  for (int i = 0; i < count; ++i) {
    auto& b = chain.state.bodies[static_cast<std::size_t>(i)];
    b.p_WB = i * (tip.p_B - root.p_B);
    b.w_WB_B = Vector3(0.0, 0.0, 1.0);
  }
  return chain;
}

}  // namespace limber::bench
