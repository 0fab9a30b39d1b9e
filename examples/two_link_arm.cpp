// SPDX-License-Identifier: BSD-3-Clause
// Strikes the tip of a bent arm, a steel rod on a rigid one, for 10 ms.
#include <cstdio>

#include "limber/dynamics/equations/joint_state.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/reduction/reduce.hpp"

int main(int, char** argv) {
  using namespace limber;
  flexbody::Recipe recipe;
  recipe.mesh.file = argv[1];  // meshes/rod.geo, 0.5 m along x
  recipe.materials = {{"", {210e9, 0.3, 7850.0}}};
  recipe.interfaces = {{"root", flexbody::GroupNodes{"root"}},
                       {"tip", flexbody::GroupNodes{"tip"}}};
  const auto rod = std::make_shared<flexbody::ReducedBody>(reduce(recipe));
  const Pose root{Matrix3::Identity(), rod->interfaces[0].p_B};
  const Pose tip{Matrix3::Identity(), rod->interfaces[1].p_B};
  dynamics::SystemBuilder arm;
  const auto upper = arm.add_rigid_body("upper", {rod->mass, rod->inertia()});
  const auto lower =
      arm.add_flexible_body("lower", rod, dynamics::Fidelity::coupled, {});
  const auto hinge = joints::JointKind::revolute;  // about z
  arm.add_joint("shoulder", hinge, {}, {upper, root});
  arm.add_joint("elbow", hinge, {upper, tip}, {lower, {}, "root"});
  const auto hand =
      arm.attach_interface("hand", lower, rod->interfaces[1], tip);
  arm.add_load("strike", hand, {-20, 0, 0}, {0, 0, 0},
               dynamics::LoadFrame::world, dynamics::Pulse{.duration = 0.01});
  const dynamics::SystemModel model = arm.build();
  auto state = make_state(model, {{"elbow", {{1.5707963267948966}, {}}}});
  simulate(model, state,
           {.end_time = 0.1, .step = 1e-4, .output_times = {0.01, 0.1}},
           [&](auto& now, auto& energy) {
             const Vector3 p = find_frame_motion(model, now, hand).X_WF.p;
             std::printf("t = %.2f s  hand (%.3f, %.3f) m  Lz = %.3f N m s\n",
                         now.t, p.x(), p.y(), energy.angular_momentum.z());
           });
}
